// Sums of splats are exact integer sums, whatever the order, with and without 64-bit atomics; leaving the range is
// noticed.
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace quasilux {
namespace {

struct Sums {
    std::vector<uint32_t> words; ///< R, G, B, low word first
    std::vector<float> taken;
    unsigned overflows = 0;
    int64_t whole(size_t channel) const {
        return static_cast<int64_t>(uint64_t(words[2 * channel + 1]) << 32 | words[2 * channel]);
    }
};

Sums add(const std::vector<float>& values, const std::string& options) {
    Program program = testProgram("splat_sums.cl", options);
    Buffer<float> input(testDevice(), values, "values"), taken(testDevice(), 3, "taken");
    Buffer<uint32_t> sums(testDevice(), 6, "sums"), overflows(testDevice(), values.size(), "overflows");
    sums.fill(0);
    program.kernel("addAll").launch(values.size(), input, sums, overflows, unsigned(values.size()));
    Sums result;
    result.words = sums.read();
    for (const auto n : overflows.read()) result.overflows += n;
    program.kernel("takeAll").launch(1, sums, taken);
    result.taken = taken.read();
    for (const auto word : sums.read()) EXPECT_EQ(word, 0u) << "taken sums are set to 0";
    return result;
}

class SplatSums : public testing::TestWithParam<const char*> {};

TEST_P(SplatSums, AreExactIntegerSums) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-3, 45);
    std::vector<float> values(20000);
    int64_t expected = 0, magnitude = 0;
    for (auto& value : values) {
        value = std::exp2(exponent(random)) * (random() % 2 ? 1.f : -1.f);
        const auto quanta = static_cast<int64_t>(value + std::copysign(0.5f, value));
        expected += quanta;
        magnitude += std::abs(quanta);
    }
    ASSERT_GT(magnitude, int64_t(1) << 50) << "carries must occur";
    const Sums sums = add(values, GetParam());
    EXPECT_EQ(sums.whole(0), expected);
    EXPECT_EQ(sums.whole(1), -expected);
    EXPECT_EQ(sums.whole(2), int64_t(values.size()));
    EXPECT_EQ(sums.overflows, 0u);
    EXPECT_EQ(sums.taken, (std::vector<float>{float(expected), -float(expected), float(values.size())}));
}

TEST_P(SplatSums, LeavingTheRangeIsCounted) {
    EXPECT_EQ(add({0x1p60f, 0x1p60f, 0x1p60f}, GetParam()).overflows, 0u);
    EXPECT_EQ(add(std::vector<float>(3, 0x1p61f), GetParam()).overflows, 0u);
    EXPECT_GE(add(std::vector<float>(5, 0x1p61f), GetParam()).overflows, 1u); // 1.25 * 2^63
    EXPECT_GE(add({0x1p62f}, GetParam()).overflows, 1u) << "one splat that is too large";
}

INSTANTIATE_TEST_SUITE_P(Atomics, SplatSums, testing::Values("", "-DSPLAT_BY_WORDS"));

} // namespace
} // namespace quasilux
