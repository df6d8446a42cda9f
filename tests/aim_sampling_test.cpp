// Aimed directions (kernels/aim.clh): their density is that of the opening which they were drawn to, whatever rounding
// does, and nothing unknown is aimed at. No chance: numbers are those of a lattice.
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

/// Share of directions to a small square far away whose density is less than half of what it is.
double shareTooRare(const std::string& options) {
    constexpr unsigned count = 200000;
    constexpr float halfWidth = 0.02f, distance = 99;
    shared::AimSource square{};
    square.opening.centre = {distance, 0.3f, 0.2f};
    square.opening.axisU = {0, 1, 0};
    square.opening.axisV = {0, 0, 1};
    square.opening.halfU = square.opening.halfV = halfWidth;
    square.share = 1;
    square.count = 1;
    std::vector<float> numbers;
    for (unsigned i = 0; i < count; ++i) {
        numbers.push_back(float((i + 0.5) / count));
        numbers.push_back(float(std::fmod(i * std::numbers::phi, 1)));
    }
    const Program program = testProgram("aim.cl", "-DHAS_EMITTER_RECTANGLE -DBVH_STACK_SIZE=8 " + options);
    const Buffer<shared::AimSource> openings(testDevice(), std::vector{square}, "openings");
    const Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), count, "densities");
    program.kernel("aimAtOpening").launch(count, openings, 0.f, 0.f, 0.f, in, out, count);
    const double pdf = double(distance) * distance / (4 * halfWidth * halfWidth); // within a part in 10^4
    double rare = 0;
    for (const float value : out.read()) {
        rare += value < 0.5 * pdf;
        EXPECT_LT(value, 1.001 * pdf);
    }
    return rare / count;
}

TEST(AimSampling, ADirectionIsInTheOpeningThatItWasDrawnTo) {
    EXPECT_EQ(shareTooRare(""), 0);
    EXPECT_GT(shareTooRare("-DAIM_RULE=1"), 1e-5) << "negative control: by where rounding puts it";
}

TEST(AimSampling, UnknownCellsAimAsThoseOfWhichNothingIsKnown) {
    const Program program = testProgram("aim.cl", "-DHAS_EMITTER_RECTANGLE -DBVH_STACK_SIZE=8");
    const Buffer<float> aims(testDevice(), 3, "aim");
    shared::SceneTables scene{};
    scene.learned.aimCount = 5;
    scene.learned.aimSets = 1;
    const auto aimOf = [&](uint32_t word) {
        const Buffer<uint32_t> tables(testDevice(), std::vector<uint32_t>{0, 0, 0, word}, "tables");
        program.kernel("aimOfWord").launch(1, tables, scene, aims);
        return aims.read();
    };
    EXPECT_EQ(aimOf(IMPORTANCE_UNKNOWN), aimOf(0));
    EXPECT_EQ(aimOf(0)[1], 5) << "all of them";
}

} // namespace
} // namespace quasilux
