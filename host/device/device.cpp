#include "device/device.h"

#include "util/error.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace quasilux {

namespace {

// Intel's compiler for CPUs runs several work-items in the lanes of a vector, which these kernels, written in vectors,
// do not gain from, and some it makes wrong or crashes over (docs/notes/devices.md). It reads this when it is loaded;
// what the user has set stays.
void turnOffIntelVectorizer() { setenv("CL_CONFIG_CPU_VECTORIZER_MODE", "1", 0); }

constexpr cl_int noPlatform = -1001; // CL_PLATFORM_NOT_FOUND_KHR of the loader, without any ICD

/// Of all runtimes that answer. Throws cl::Error where none does, and one fails.
std::vector<cl::Device> allDevices() {
    static std::once_flag once;
    std::call_once(once, turnOffIntelVectorizer);
    std::vector<cl::Platform> platforms;
    std::optional<cl::Error> failure;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error& error) {
        if (error.err() != noPlatform) throw;
    }
    std::vector<cl::Device> devices;
    for (const auto& platform : platforms) {
        std::vector<cl::Device> here;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &here);
        } catch (const cl::Error& error) {
            if (error.err() != CL_DEVICE_NOT_FOUND) failure = error;
            continue;
        }
        devices.insert(devices.end(), here.begin(), here.end());
    }
    if (devices.empty() && failure) throw *failure;
    return devices;
}

/// What `query` returns; where OpenCL refuses it, the error names what failed.
template <typename Query>
auto ask(const Query& query) {
    try {
        return query();
    } catch (const cl::Error& error) {
        throw DeviceError(fmt::format("an OpenCL device could not be queried: {} failed with OpenCL error {}",
                                      error.what(), error.err()));
    }
}

DeviceInfo describe(const cl::Device& device) {
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    DeviceInfo info;
    info.name = device.getInfo<CL_DEVICE_NAME>();
    info.platform = platform.getInfo<CL_PLATFORM_NAME>();
    info.version = device.getInfo<CL_DEVICE_VERSION>();
    info.driver = device.getInfo<CL_DRIVER_VERSION>();
    info.computeUnits = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.globalMemory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.maximumAllocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.isCpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    return info;
}

cl::Device pick(int index) {
    const auto devices = allDevices();
    if (devices.empty())
        throw InputError("no OpenCL device found, expected at least one: install a runtime, such as the Debian package "
                         "pocl-opencl-icd for the CPU");
    if (index >= static_cast<int>(devices.size()) || index < -1)
        throw InputError(fmt::format("--device {}: no such device, expected 0 to {} (or -1: the first GPU, else the "
                                     "first device); `quasilux devices` lists them",
                                     index, devices.size() - 1));
    if (index >= 0) return devices[static_cast<size_t>(index)];
    for (const auto& device : devices)
        if ((device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_GPU) != 0) return device;
    return devices.front();
}

/// Parts with so many compute units each. Throws cl::Error where the device cannot be divided. They are kept until the
/// program ends: PoCL 3.1 looks at the device of an event once more after the queue has finished, and crashes if that
/// is a part which has been released by then.
std::vector<cl::Device> partsOf(cl::Device& device, unsigned computeUnits, unsigned count) {
    static std::mutex mutex;
    static auto& known = *new std::map<std::tuple<cl_device_id, unsigned, unsigned>, std::vector<cl::Device>>;
    const std::scoped_lock lock(mutex);
    std::vector<cl::Device>& parts = known[{device(), computeUnits, count}];
    if (!parts.empty()) return parts;
    std::vector<cl_device_partition_property> counts(count + 3);
    counts.front() = CL_DEVICE_PARTITION_BY_COUNTS;
    std::fill_n(counts.begin() + 1, count, static_cast<cl_device_partition_property>(computeUnits));
    counts[count + 1] = CL_DEVICE_PARTITION_BY_COUNTS_LIST_END;
    device.createSubDevices(counts.data(), &parts);
    return parts;
}

cl::Device partOf(cl::Device& device, const DeviceChoice& choice, const DeviceInfo& info) {
    const unsigned units = info.computeUnits / choice.parts;
    if (units == 0)
        throw InputError(fmt::format("--device {}/{}: {} has {} compute units, so it cannot be divided into {} parts",
                                     choice.index, choice.parts, info.name, info.computeUnits, choice.parts));
    return partsOf(device, units, choice.parts).at(choice.part);
}

constexpr size_t hugePage = size_t(2) << 20;

/// Rays through a large tree touch pages at random: with 4 KiB pages most of the time goes into finding these.
bool hugePagesHelp(const DeviceInfo& device, size_t bytes) { return device.isCpu && bytes >= hugePage; }

/// Memory of the host that a CPU device uses as it is.
cl::Buffer bufferOfHugePages(cl::Context& context, size_t bytes) {
    const size_t whole = (bytes + hugePage - 1) / hugePage * hugePage;
    void* memory = std::aligned_alloc(hugePage, whole);
    if (!memory) throw cl::Error(CL_MEM_OBJECT_ALLOCATION_FAILURE, "aligned_alloc");
    std::unique_ptr<void, decltype(&std::free)> owner(memory, &std::free);
#ifdef MADV_HUGEPAGE
    madvise(memory, whole, MADV_HUGEPAGE); // where the system refuses, pages stay small
#endif
    cl::Buffer buffer(context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, memory);
    buffer.setDestructorCallback([](cl_mem, void* pages) { std::free(pages); }, memory);
    static_cast<void>(owner.release());
    return buffer;
}

} // namespace

void addTimings(std::map<std::string, KernelTiming>& all, const std::map<std::string, KernelTiming>& part) {
    for (const auto& [kernel, timing] : part) {
        KernelTiming& sum = all[kernel];
        sum.launches += timing.launches;
        sum.seconds += timing.seconds;
        sum.privateBytes = timing.privateBytes;
    }
}

std::vector<DeviceInfo> listDevices() {
    std::vector<DeviceInfo> list;
    for (const auto& device : ask(allDevices)) list.push_back(ask([&] { return describe(device); }));
    return list;
}

Device::Device(const DeviceChoice& choice, unsigned workGroupSize, uint64_t memoryLimit, unsigned computeUnits,
               uint64_t bufferLimit)
    : workGroupSize_(workGroupSize) {
    device_ = ask([&] { return pick(choice.index); });
    info_ = ask([&] { return describe(device_); });
    info_.globalMemory /= choice.parts;
    info_.maximumAllocation = std::min(info_.maximumAllocation, info_.globalMemory);
    if (memoryLimit > 0) {
        info_.globalMemory = std::min(info_.globalMemory, memoryLimit);
        info_.maximumAllocation = std::min(info_.maximumAllocation, memoryLimit);
    }
    if (bufferLimit > 0) info_.maximumAllocation = std::min(info_.maximumAllocation, bufferLimit);
    try {
        if (choice.parts > 1) {
            device_ = partOf(device_, choice, info_);
            info_.computeUnits /= choice.parts;
        } else if (computeUnits > 0 && computeUnits < info_.computeUnits) {
            device_ = partsOf(device_, computeUnits, 1).at(0);
            info_.computeUnits = computeUnits;
        }
        context_ = cl::Context(device_);
        queue_ = cl::CommandQueue(context_, device_, CL_QUEUE_PROFILING_ENABLE);
    } catch (const cl::Error& error) {
        throw DeviceError(
            fmt::format("device {}: {} failed with OpenCL error {}", info_.name, error.what(), error.err()));
    }
}

Allocation Device::allocate(size_t bytes, const std::string& label) {
    constexpr double mib = 1024.0 * 1024.0;
    if (bytes > info_.maximumAllocation)
        throw InputError(fmt::format("buffer '{}' needs {:.1f} MiB, but device {} allows {:.1f} MiB in one buffer: use "
                                     "fewer --photons or a smaller film",
                                     label, bytes / mib, info_.name, info_.maximumAllocation / mib));
    const uint64_t others = inUse_->now;
    if (others + bytes > info_.globalMemory)
        throw InputError(fmt::format("buffer '{}' of {:.1f} MiB comes to {:.1f} MiB in use, but device {} has {:.1f} "
                                     "MiB, {:.1f} MiB too little: use fewer --photons or a smaller film",
                                     label, bytes / mib, (others + bytes) / mib, info_.name, info_.globalMemory / mib,
                                     (others + bytes - info_.globalMemory) / mib));
    try {
        cl::Buffer buffer = hugePagesHelp(info_, bytes) ? bufferOfHugePages(context_, bytes)
                                                        : cl::Buffer(context_, CL_MEM_READ_WRITE, bytes);
        if (notes_) (*notes_)[label] = bytes;
        inUse_->now += bytes;
        inUse_->peak = std::max(inUse_->peak, inUse_->now);
        return {buffer, std::shared_ptr<const void>(nullptr, [inUse = inUse_, bytes](auto) { inUse->now -= bytes; })};
    } catch (const cl::Error& error) {
        throw DeviceError(fmt::format("buffer '{}' of {:.1f} MiB could not be allocated on device {} (OpenCL error {})",
                                      label, bytes / mib, info_.name, error.err()));
    }
}

double secondsOf(const cl::Event& event) {
    return 1e-9 * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() -
                                      event.getProfilingInfo<CL_PROFILING_COMMAND_START>());
}

void Device::run(const std::function<void()>& command) {
    try {
        command();
    } catch (const cl::Error& error) {
        throw DeviceError(fmt::format("device {}: {} failed (OpenCL error {})", info_.name, error.what(), error.err()));
    }
}

void Device::finish() {
    run([&] { queue_.finish(); });
}

void Device::addTiming(const std::string& kernel, uint64_t privateBytes, const cl::Event& event) {
    timings_[kernel].privateBytes = privateBytes;
    pending_.emplace_back(kernel, event);
}

double Device::pace(const std::string& kernel) const {
    const auto found = paces_.find(kernel);
    return found == paces_.end() ? 0 : found->second;
}

void Device::notePace(const std::string& kernel, double secondsPerItem) {
    if (keepsPaces_) paces_[kernel] = secondsPerItem;
}

void Device::resetTimings(std::map<std::string, KernelTiming> earlier) {
    finish();
    pending_.clear();
    timings_ = std::move(earlier);
}

const std::map<std::string, KernelTiming>& Device::timings() {
    finish();
    const auto ended = std::exchange(pending_, {}); // also where one of them cannot be asked
    run([&] {
        for (const auto& [kernel, event] : ended) {
            auto& timing = timings_[kernel];
            ++timing.launches;
            timing.seconds += secondsOf(event);
        }
    });
    return timings_;
}

} // namespace quasilux
