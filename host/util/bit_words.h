// Bits in the words that kernels read: bit k is bit k % 32 of word k / 32.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace quasilux {

inline constexpr std::size_t bitsOfWord = 32;

inline bool bitAt(const std::vector<uint32_t>& words, std::size_t k) {
    return (words[k / bitsOfWord] >> k % bitsOfWord & 1) != 0;
}

inline void setBit(std::vector<uint32_t>& words, std::size_t k) { words[k / bitsOfWord] |= 1u << k % bitsOfWord; }

} // namespace quasilux
