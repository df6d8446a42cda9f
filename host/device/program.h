// Kernel programs: sources joined with #line marks, built with the scene's features, launched by name.
#pragma once

#include "device/buffer.h"
#include "device/launch_pace.h"

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace quasilux {

/// `source` with every `#include "…"` replaced by the file's text (each file once), with #line marks so that build
/// errors name the real file; a `*` in the name includes every file that fits. `extra` adds or replaces files (tests).
/// Throws DeviceError for an unknown include.
std::string joinKernelSource(const std::string& file, const std::map<std::string, std::string>& extra = {});

class Kernel {
public:
    Kernel() = default;
    Kernel(Device& device, cl::Kernel kernel, std::string name);

    /// Runs `count` work-items (rounded up to whole groups; the kernel must check its index against its count).
    template <typename... Args>
    void launch(size_t count, const Args&... args) {
        launchInGroupsOf(device_->workGroupSize(), count, args...);
    }

    /// The same for work-items that are long, such as a region of paths: on a CPU each is a group of its own, since a
    /// group runs on one core and a few large ones leave the others idle at the end.
    template <typename... Args>
    void launchLong(size_t count, const Args&... args) {
        launchInGroupsOf(device_->info().isCpu ? 1 : device_->workGroupSize(), count, args...);
    }

    /// Called when a part of the work-items is done, with the number so far, where launches are split; empty: no more.
    /// A launch takes no longer than `longest` seconds meanwhile.
    void watchParts(std::function<void(size_t)> afterPart, double longest = longestLaunchSeconds) {
        afterPart_ = std::move(afterPart);
        longestPart_ = longest;
    }

    /// The launches so far were of other work, or of none, made so that the runtime compiles the kernel.
    void forgetPace();

private:
    template <typename... Args>
    void launchInGroupsOf(size_t group, size_t count, const Args&... args) {
        cl_uint index = 0;
        (setArgument(index++, args), ...);
        enqueue(count, group);
    }
    template <typename T>
    void setArgument(cl_uint index, const Buffer<T>& buffer) {
        set(index, [&] { kernel_.setArg(index, buffer.memory()); });
    }
    template <typename T, typename = std::enable_if_t<std::is_trivially_copyable_v<T>>>
    void setArgument(cl_uint index, const T& value) {
        set(index, [&] { kernel_.setArg(index, sizeof(T), &value); });
    }
    void set(cl_uint index, const std::function<void()>& argument);
    /// In as many launches as longestLaunchSeconds asks for, each of which is waited for if there are several. In
    /// groups of `asked`, or of as many as the device can run of this kernel.
    void enqueue(size_t count, size_t asked);
    cl::Event enqueuePart(size_t first, size_t count, size_t group);
    void notePace();

    Device* device_ = nullptr;
    cl::Kernel kernel_;
    std::string name_;
    uint64_t privateBytes_ = 0;
    /// Work-items that the device can run in a group of this kernel: registers may leave room for few
    size_t largestGroup_ = 1;
    LaunchPace pace_;
    double paceBefore_ = 0; ///< Device::pace() when this was made
    cl::Event last_;        ///< the last launch
    size_t lastCount_ = 0;
    std::function<void(size_t)> afterPart_;
    double longestPart_ = longestLaunchSeconds;
};

class Program {
public:
    /// Builds kernels/`file`; `options` are such as "-DHAS_LOBE_PHONG". Throws DeviceError with the build log.
    Program(Device& device, const std::string& file, const std::string& options,
            const std::map<std::string, std::string>& extra = {});

    /// Builds kernels of another file besides, with options of its own: what does not depend on the scene is taken from
    /// the runtime's cache for the next one.
    void add(const std::string& file, const std::string& options);

    /// From the file that holds it.
    Kernel kernel(const std::string& name) const;

private:
    Device* device_;
    std::string files_;
    std::vector<cl::Program> programs_;
};

} // namespace quasilux
