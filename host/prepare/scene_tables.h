// All small scene tables in one buffer of 32-bit words, since OpenCL kernels take few buffers.
#pragma once

#include "pass_types.h"
#include "util/error.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

class SceneTableWriter {
public:
    /// Kernels know places by 32 bits, of which QL_NONE means none.
    static constexpr size_t mostWords = QL_NONE;

    SceneTableWriter() = default;
    /// Goes on behind these. There may be no more than `most` words.
    explicit SceneTableWriter(std::vector<uint32_t> words, size_t most = mostWords)
        : words_(std::move(words)), most_(most) {}

    /// Appends `records` and returns the word offset where they begin. Throws InputError where they do not fit.
    template <typename T>
    unsigned append(const std::vector<T>& records) {
        static_assert(sizeof(T) % sizeof(uint32_t) == 0);
        constexpr size_t wordsPerRecord = sizeof(T) / 4;
        if (words_.size() > most_ || records.size() > (most_ - words_.size()) / wordsPerRecord)
            throw InputError("the tables of the scene would have more than " + std::to_string(most_) +
                             " words of 4 bytes, the most that kernels can address: use simpler meshes, fewer or "
                             "smaller textures");
        const auto first = static_cast<unsigned>(words_.size());
        words_.insert(words_.end(), records.size() * wordsPerRecord, 0u);
        if (!records.empty()) std::memcpy(words_.data() + first, records.data(), records.size() * sizeof(T));
        return first;
    }
    /// Room for so many further words.
    void reserve(size_t words) { words_.reserve(words_.size() + words); }
    const std::vector<uint32_t>& words() const { return words_; }
    std::vector<uint32_t> take() && { return std::move(words_); }

private:
    std::vector<uint32_t> words_;
    size_t most_ = mostWords;
};

} // namespace quasilux
