// XXH3 of 128 bits (the library xxHash): tells whether bytes are what they were. No protection against who means harm.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace quasilux {

class Checksum {
public:
    static constexpr size_t bytes = 16;

    Checksum();
    ~Checksum();

    void add(const void* data, size_t size);
    template <typename T>
    void add(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(values.data(), values.size() * sizeof(T));
    }
    /// Of all that was added so far: `bytes` bytes, the same on every machine.
    std::string digest() const;
    /// The same in hexadecimal digits.
    std::string text() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace quasilux
