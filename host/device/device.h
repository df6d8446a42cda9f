// One OpenCL device with its context, queue, kernels and timing table. The only folder that calls OpenCL
// (docs/notes/devices.md).
#pragma once

#include "device/device_choice.h"
#include "device/launch_pace.h"

#include <CL/opencl.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace quasilux {

struct DeviceInfo {
    std::string name, platform, version, driver;
    unsigned computeUnits = 0;
    uint64_t globalMemory = 0;      ///< bytes
    uint64_t maximumAllocation = 0; ///< bytes
    bool isCpu = false;
};

/// All OpenCL devices of all platforms; the index is the number that `--device` takes.
std::vector<DeviceInfo> listDevices();

/// Time spent in one kernel, from the runtime's profiling counters.
struct KernelTiming {
    uint64_t launches = 0;
    double seconds = 0;
    uint64_t privateBytes = 0; ///< private memory of a work-item, as the runtime reports; 0 where it does not
};

/// Of other launches.
void addTimings(std::map<std::string, KernelTiming>& all, const std::map<std::string, KernelTiming>& part);

/// Device memory; its bytes count as in use until the last copy is gone.
struct Allocation {
    cl::Buffer memory;
    std::shared_ptr<const void> use;
};

/// That a command took on the device. Throws cl::Error.
double secondsOf(const cl::Event& event);

class Device {
public:
    /// Throws InputError if there is no such device. One of several parts has its share of the compute units and of the
    /// memory. `memoryLimit`, bytes: the device is taken to have no more; 0: what it has. `computeUnits` of it alone
    /// are used; 0 = all. `bufferLimit`, bytes: likewise of one buffer.
    explicit Device(const DeviceChoice& choice = {}, unsigned workGroupSize = 64, uint64_t memoryLimit = 0,
                    unsigned computeUnits = 0, uint64_t bufferLimit = 0);

    const DeviceInfo& info() const { return info_; }
    cl::Context& context() { return context_; }
    cl::CommandQueue& queue() { return queue_; }
    const cl::Device& device() const { return device_; }
    unsigned workGroupSize() const { return workGroupSize_; }
    /// No launch of a kernel is to last longer than so many seconds.
    double longestLaunch() const { return longestLaunch_; }
    void setLongestLaunch(double seconds) { longestLaunch_ = seconds; }
    /// Work is from now on divided as for a GPU, for tests on machines without one.
    void divideAsForGpu() { info_.isCpu = false; }

    /// `beforeLaunch` is called by who launches kernels, before each launch, also of those that a long one is split
    /// into. What it throws ends the work. Empty: nobody.
    void watchLaunches(std::function<void()> beforeLaunch) { beforeLaunch_ = std::move(beforeLaunch); }
    void noteLaunch() const {
        if (beforeLaunch_) beforeLaunch_();
    }
    /// From now on kernels begin with the pace of those of the same name before, so that the first launch is split,
    /// too: for renders that follow each other. On a CPU a first launch is one piece otherwise (launch_pace.h).
    void keepPaces() { keepsPaces_ = true; }
    /// Seconds that a work-item takes; 0: not known.
    double pace(const std::string& kernel) const;
    void notePace(const std::string& kernel, double secondsPerItem);

    /// Throws InputError that names `label` and by how much what is in use would exceed the limit, DeviceError if the
    /// device refuses.
    Allocation allocate(size_t bytes, const std::string& label);
    /// Most bytes that were in use at once, of all renderers on this device.
    uint64_t peakBytes() const { return inUse_->peak; }

    /// Waits for all work.
    void finish();

    void addTiming(const std::string& kernel, uint64_t privateBytes, const cl::Event& event);
    /// Waits, then sums what addTiming collected.
    const std::map<std::string, KernelTiming>& timings();
    /// Takes timings() back to what they were.
    void resetTimings(std::map<std::string, KernelTiming> earlier);
    /// Runs `command`, which uses OpenCL's queue; throws DeviceError with the device's name where it fails.
    void run(const std::function<void()>& command);

private:
    DeviceInfo info_;
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    unsigned workGroupSize_;
    double longestLaunch_ = longestLaunchSeconds;
    std::function<void()> beforeLaunch_;
    bool keepsPaces_ = false;
    std::map<std::string, double> paces_; ///< by kernel
    struct InUse {
        uint64_t now = 0, peak = 0;
    };
    std::shared_ptr<InUse> inUse_ = std::make_shared<InUse>(); ///< shared with buffers, which may outlive the device
    friend class AllocationNotes;
    std::map<std::string, uint64_t>* notes_ = nullptr; ///< AllocationNotes
    std::vector<std::pair<std::string, cl::Event>> pending_;
    std::map<std::string, KernelTiming> timings_;
};

/// While it lives, buffers that are allocated are noted in `sizes`, bytes by label (a label used twice holds the later
/// size). Several renderers share a device; each notes its own.
class AllocationNotes {
public:
    AllocationNotes(Device& device, std::map<std::string, uint64_t>& sizes) : device_(device), outer_(device.notes_) {
        device.notes_ = &sizes;
    }
    ~AllocationNotes() { device_.notes_ = outer_; }
    AllocationNotes(const AllocationNotes&) = delete;
    AllocationNotes& operator=(const AllocationNotes&) = delete;

private:
    Device& device_;
    std::map<std::string, uint64_t>* outer_;
};

} // namespace quasilux
