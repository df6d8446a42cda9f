// All small scene tables in one buffer of 32-bit words, since OpenCL kernels take few buffers.
#pragma once

#include "pass_types.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace quasilux {

class SceneTableWriter {
public:
    SceneTableWriter() = default;
    /// Goes on behind these.
    explicit SceneTableWriter(std::vector<uint32_t> words) : words_(std::move(words)) {}

    /// Appends `records` and returns the word offset where they begin.
    template <typename T>
    unsigned append(const std::vector<T>& records) {
        static_assert(sizeof(T) % sizeof(uint32_t) == 0);
        const auto first = static_cast<unsigned>(words_.size());
        constexpr size_t wordsPerRecord = sizeof(T) / 4;
        words_.insert(words_.end(), records.size() * wordsPerRecord, 0u);
        if (!records.empty()) std::memcpy(words_.data() + first, records.data(), records.size() * sizeof(T));
        return first;
    }
    const std::vector<uint32_t>& words() const { return words_; }

private:
    std::vector<uint32_t> words_;
};

} // namespace quasilux
