// What a render has to keep, as named arrays of plain data: written one after the other, read by name.
#pragma once

#include "util/error.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace quasilux {

class StateSink {
public:
    virtual ~StateSink() = default;
    /// The bytes of this array follow by write().
    virtual void begin(const std::string& name) = 0;
    virtual void write(const void* data, size_t bytes) = 0;

    template <typename T>
    void array(const std::string& name, const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        begin(name);
        write(values.data(), values.size() * sizeof(T));
    }
    template <typename T>
    void record(const std::string& name, const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        begin(name);
        write(&value, sizeof value);
    }
};

class StateSource {
public:
    virtual ~StateSource() = default;
    virtual bool has(const std::string& name) const = 0;
    /// Throws InputError where there is no such array, as do all that follow.
    virtual uint64_t bytes(const std::string& name) const = 0;
    virtual void read(const std::string& name, uint64_t offset, void* into, size_t bytes) const = 0;

    template <typename T>
    std::vector<T> array(const std::string& name) const {
        static_assert(std::is_trivially_copyable_v<T>);
        requireBytes(name, bytes(name) / sizeof(T) * sizeof(T));
        std::vector<T> values(bytes(name) / sizeof(T));
        read(name, 0, values.data(), values.size() * sizeof(T));
        return values;
    }
    template <typename T>
    T record(const std::string& name) const {
        static_assert(std::is_trivially_copyable_v<T>);
        requireBytes(name, sizeof(T));
        T value;
        read(name, 0, &value, sizeof value);
        return value;
    }
    /// Throws InputError where the array has another size.
    void requireBytes(const std::string& name, uint64_t expected) const {
        if (bytes(name) != expected)
            throw InputError("'" + name + "' has " + std::to_string(bytes(name)) + " bytes, expected " +
                             std::to_string(expected) + ": the checkpoint is of another version of quasilux");
    }
};

/// Large arrays are read and written in pieces of so many values.
inline constexpr size_t valuesAtOnce = size_t(4) << 20;

} // namespace quasilux
