// A device buffer before it is made: who owns it makes it of this, and the forecast of memory reads its size here.
#pragma once

#include "device/buffer.h"

#include <cstdint>
#include <map>
#include <string>

namespace quasilux {

/// Bytes of device buffers by label, as Device::allocations() has them.
using BufferSizes = std::map<std::string, uint64_t>;

template <typename T>
struct PlannedBuffer {
    std::string label;
    size_t count = 0;

    Buffer<T> make(Device& device) const { return {device, count, label}; }
};

template <typename... T>
BufferSizes sizesOf(const PlannedBuffer<T>&... buffers) {
    return {{buffers.label, Buffer<T>::bytesOf(buffers.count)}...};
}

} // namespace quasilux
