// Typed device memory.
#pragma once

#include "device/device.h"

#include <vector>

namespace quasilux {

/// An array of `T` on the device. An empty array is backed by one element, since OpenCL has no buffers of 0 bytes.
template <typename T>
class Buffer {
public:
    static constexpr uint64_t bytesOf(size_t count) { return uint64_t{count ? count : 1} * sizeof(T); }

    Buffer() = default;
    Buffer(Device& device, size_t count, const std::string& label)
        : device_(&device), count_(count), allocation_(device.allocate(bytesOf(count), label)) {}
    Buffer(Device& device, const std::vector<T>& data, const std::string& label) : Buffer(device, data.size(), label) {
        write(data);
    }

    size_t size() const { return count_; }
    const cl::Buffer& memory() const { return allocation_.memory; }

    void write(const std::vector<T>& data) {
        if (data.empty()) return;
        device_->run(
            [&] { device_->queue().enqueueWriteBuffer(memory(), CL_TRUE, 0, data.size() * sizeof(T), data.data()); });
    }
    /// From the value `first` on.
    void writeAt(size_t first, const std::vector<T>& data) {
        if (data.empty()) return;
        device_->run([&] {
            device_->queue().enqueueWriteBuffer(memory(), CL_TRUE, first * sizeof(T), data.size() * sizeof(T),
                                                data.data());
        });
    }
    std::vector<T> read(size_t first = 0, size_t count = SIZE_MAX) const {
        std::vector<T> data(count == SIZE_MAX ? count_ - first : count);
        if (data.empty()) return data;
        device_->run([&] {
            device_->queue().enqueueReadBuffer(memory(), CL_TRUE, first * sizeof(T), data.size() * sizeof(T),
                                               data.data());
        });
        return data;
    }
    void fill(T value) {
        device_->run([&] { device_->queue().enqueueFillBuffer(memory(), value, 0, bytesOf(count_)); });
    }

private:
    Device* device_ = nullptr;
    size_t count_ = 0;
    Allocation allocation_;
};

} // namespace quasilux
