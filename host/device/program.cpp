#include "device/program.h"

#include "device/kernel_sources.h"
#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace quasilux {

namespace {

using Sources = std::map<std::string, std::string>;

const std::string& sourceText(const std::string& file, const Sources& extra) {
    if (const auto found = extra.find(file); found != extra.end()) return found->second;
    const auto& sources = kernelSources();
    if (const auto found = sources.find(file); found != sources.end()) return found->second;
    throw DeviceError(fmt::format("kernel source '{}' is not built in", file));
}

// A name such as "bsdf/lobes/*.clh" stands for every built-in file of that folder and ending, in alphabetical order.
std::vector<std::string> matchingFiles(const std::string& name) {
    const auto star = name.find('*');
    if (star == std::string::npos) return {name};
    const std::string folder = name.substr(0, star), ending = name.substr(star + 1);
    std::vector<std::string> files;
    for (const auto& [file, text] : kernelSources())
        if (file.starts_with(folder) && file.ends_with(ending)) files.push_back(file);
    return files;
}

void join(const std::string& file, const Sources& extra, std::set<std::string>& seen, std::string& out) {
    static const std::regex include(R"re(^\s*#include\s+"([^"]+)"\s*$)re");
    if (!seen.insert(file).second) return;
    out += fmt::format("#line 1 \"{}\"\n", file);
    std::istringstream lines(sourceText(file, extra));
    std::string line;
    bool hasIncluded = false;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::smatch match;
        const bool includes = line.find("#include") != std::string::npos && std::regex_match(line, match, include);
        if (includes)
            for (const auto& included : matchingFiles(match[1])) join(included, extra, seen, out);
        else
            out += line + '\n';
        // A branch that is not compiled has its lines counted, with all that they include, but not its #line.
        hasIncluded |= includes;
        if (includes || (hasIncluded && line.starts_with("#e"))) // #else, #elif, #endif
            out += fmt::format("#line {} \"{}\"\n", number + 1, file);
    }
}

} // namespace

std::string joinKernelSource(const std::string& file, const Sources& extra) {
    std::set<std::string> seen;
    std::string out;
    join(file, extra, seen, out);
    return out;
}

// Of a kernel on a device; none where the runtime does not say, which is no reason to end a render.
template <typename T>
std::optional<T> groupInfo(const cl::Kernel& kernel, const cl::Device& device, cl_kernel_work_group_info what) {
    try {
        T value{};
        if (kernel.getWorkGroupInfo(device, what, &value) == CL_SUCCESS) return value;
    } catch (const cl::Error&) {
    }
    return std::nullopt;
}

// Groups on each compute unit of a first launch, of which nothing is known: enough to fill a GPU, and little work.
constexpr unsigned firstGroupsPerUnit = 4;

Kernel::Kernel(Device& device, cl::Kernel kernel, std::string name)
    : device_(&device), kernel_(std::move(kernel)), name_(std::move(name)),
      pace_(device.info().isCpu ? 0
                                : size_t(firstGroupsPerUnit) * device.info().computeUnits * device.workGroupSize()) {
    paceBefore_ = device.pace(name_);
    pace_.note(1, paceBefore_);
    privateBytes_ = groupInfo<cl_ulong>(kernel_, device.device(), CL_KERNEL_PRIVATE_MEM_SIZE).value_or(0);
    const size_t largest = groupInfo<size_t>(kernel_, device.device(), CL_KERNEL_WORK_GROUP_SIZE).value_or(0);
    largestGroup_ = largest > 0 ? std::min<size_t>(device.workGroupSize(), largest) : device.workGroupSize();
}

void Kernel::set(cl_uint index, const std::function<void()>& argument) {
    try {
        argument();
    } catch (const cl::Error& error) {
        throw DeviceError(
            fmt::format("kernel {}: argument {} was refused (OpenCL error {})", name_, index, error.err()));
    }
}

void Kernel::notePace() {
    if (lastCount_ == 0 || last_.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>() != CL_COMPLETE) return;
    pace_.note(lastCount_, secondsOf(last_));
    device_->notePace(name_, pace_.secondsPerItem());
}

void Kernel::forgetPace() {
    lastCount_ = 0;
    pace_.forget();
    pace_.note(1, paceBefore_);
    device_->notePace(name_, paceBefore_);
}

cl::Event Kernel::enqueuePart(size_t first, size_t count, size_t group) {
    cl::Event event;
    device_->queue().enqueueNDRangeKernel(kernel_, first == 0 ? cl::NullRange : cl::NDRange(first), cl::NDRange(count),
                                          cl::NDRange(group), nullptr, &event);
    device_->addTiming(name_, privateBytes_, event);
    return event;
}

void Kernel::enqueue(size_t count, size_t asked) {
    const size_t group = std::min(asked, largestGroup_), global = (count + group - 1) / group * group;
    try {
        for (size_t first = 0; first < global; first += lastCount_) {
            notePace();
            device_->noteLaunch();
            lastCount_ = pace_.next(global - first, group, std::min(device_->longestLaunch(), longestPart_));
            last_ = enqueuePart(first, lastCount_, group);
            if (lastCount_ < global) last_.wait();
            if (afterPart_ && first + lastCount_ < count) afterPart_(first + lastCount_);
        }
    } catch (const cl::Error& error) {
        throw DeviceError(
            fmt::format("kernel {} over {} work-items in groups of {} failed on device {} (OpenCL error {})", name_,
                        global, group, device_->info().name, error.err()));
    }
}

namespace {

cl::Program build(Device& device, const std::string& file, const std::string& options, const Sources& extra) {
    // In C99 a plain inline function has no definition to link where a compiler chooses not to inline it, as some for
    // GPUs do. Those for CPUs inline all, and PoCL takes twice the time to compile static ones.
    const std::string linkage = device.info().isCpu ? "" : "#undef inline\n#define inline static inline\n";
    const std::string source = linkage + joinKernelSource(file, extra);
    try {
        cl::Program program(device.context(), source);
        // Fast-math stays off: it would let the compiler assume that there is no NaN or infinity. Where the build takes
        // warnings for errors (QUASILUX_WERROR), kernels do too: users would see how many there are.
        program.build(("-cl-std=CL1.2 " + options + QUASILUX_KERNEL_OPTIONS).c_str());
        return program;
    } catch (const cl::BuildError& error) {
        std::string log;
        for (const auto& [builtFor, text] : error.getBuildLog()) log += text;
        throw DeviceError(fmt::format("kernels of {} do not build on device {} with options '{}':\n{}", file,
                                      device.info().name, options, log));
    } catch (const cl::Error& error) {
        throw DeviceError(fmt::format("kernels of {} do not build on device {} (OpenCL error {})", file,
                                      device.info().name, error.err()));
    }
}

} // namespace

Program::Program(Device& device, const std::string& file, const std::string& options, const Sources& extra)
    : device_(&device), files_(file) {
    programs_.push_back(build(device, file, options, extra)); // moved: a copy is a call that may fail
}

void Program::add(const std::string& file, const std::string& options) {
    programs_.push_back(build(*device_, file, options, {}));
    files_ += ", " + file;
}

Kernel Program::kernel(const std::string& name) const {
    cl_int code = CL_INVALID_KERNEL_NAME;
    for (const cl::Program& program : programs_) {
        try {
            return Kernel(*device_, cl::Kernel(program, name.c_str()), name);
        } catch (const cl::Error& error) {
            code = error.err();
            if (code != CL_INVALID_KERNEL_NAME) break;
        }
    }
    throw DeviceError(fmt::format("{}: no kernel '{}' (OpenCL error {})", files_, name, code));
}

} // namespace quasilux
