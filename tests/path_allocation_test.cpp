// Camera paths by pixel (CameraSampling::adaptive): how many each block has, whether the image is the same, and when
// the search chooses them.
#include "render/noise_probe.h"
#include "render/path_allocation.h"

#include "support/fake_search.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>

namespace quasilux {
namespace {

using test::optionOf, test::SamplingRule;
using testing::AllOf, testing::Ge, testing::Gt, testing::Le;

constexpr unsigned side = 16;

// Blocks in two halves, left and right.
PathNoise halves(double leftVariance, double rightVariance, double leftCost = 1, double rightCost = 1) {
    PathNoise noise{side, side, {}, {}};
    for (unsigned k = 0; k < side * side; ++k) {
        const bool isLeft = k % side < side / 2;
        noise.variance.push_back(isLeft ? leftVariance : rightVariance);
        noise.cost.push_back(isLeft ? leftCost : rightCost);
    }
    return noise;
}

double costOf(const PathNoise& noise, const std::vector<uint32_t>& counts) {
    return std::inner_product(counts.begin(), counts.end(), noise.cost.begin(), 0.0);
}

// Far from the border between the halves.
double leftOverRight(const std::vector<uint32_t>& counts) { return double(counts.front()) / counts[side - 1]; }

// But for the paths that all have, and rounding.
TEST(PathAllocation, GoesAsTheRootOfVarianceOverCost) {
    EXPECT_THAT(leftOverRight(allocatePaths(halves(16, 1), 16)), AllOf(Ge(2), Le(4)));
    EXPECT_THAT(leftOverRight(allocatePaths(halves(1, 1, 16, 1), 16)), AllOf(Ge(0.25), Le(0.5)));
    EXPECT_EQ(leftOverRight(allocatePaths(halves(16, 1, 16, 1), 16)), 1);
}

TEST(PathAllocation, CostsNoMoreThanEvenSampling) {
    for (const auto& noise : {halves(16, 1), halves(1, 1, 16, 1), halves(100, 1, 3, 1), halves(1e-6, 1), halves(5, 4)})
        for (const unsigned paths : {4u, 16u, 64u}) {
            const double share = costOf(noise, allocatePaths(noise, paths)) /
                                 (paths * costOf(noise, std::vector<uint32_t>(side * side, 1)));
            EXPECT_LE(share, 1);
            EXPECT_GT(share, 0.5) << "rounding loses less than a power of two";
        }
}

TEST(PathAllocation, IsEvenWhereNoiseIs) {
    for (const double variance : {0.0, 1e-9, 1.0, 1e9})
        for (const uint32_t count : allocatePaths(halves(variance, variance), 8)) EXPECT_EQ(count, 8u);
}

// Nothing that is not seen by a few paths is left without any, and no pixel holds up all others.
TEST(PathAllocation, KeepsPathsEverywhere) {
    PathNoise one = halves(0, 0);
    one.variance[0] = 1;
    const auto counts = allocatePaths(one, 16);
    for (const uint32_t count : counts) {
        EXPECT_GE(count, 1u);
        EXPECT_LE(count, 16u * 64);
    }
    EXPECT_GT(counts.front(), counts.back());
    constexpr unsigned large = 128;
    PathNoise few{large, large, std::vector<double>(large * large, 0), std::vector<double>(large * large, 1)};
    few.variance[0] = 1;
    EXPECT_EQ(allocatePaths(few, 16).front(), 16u * 64);
}

// (16 + 1) / 2 of even sampling against ((4 + 1) / 2)^2 at the best, 1.36 times less; rounding and the paths that all
// have take a part of it. Negative control: of noise that lies elsewhere the same paths leave more than even ones.
TEST(PathAllocation, SavesVariance) {
    const auto counts = allocatePaths(halves(16, 1), 64);
    const double cost = costOf(halves(16, 1), counts) / (64.0 * side * side);
    EXPECT_THAT(varianceSaved(halves(16, 1), counts, 64) / cost, AllOf(Gt(1.2), Le(1.36)));
    EXPECT_LT(varianceSaved(halves(1, 16), counts, 64) / cost, 0.8) << "negative control";
}

// A noise probe's two halves, a rare path met in one of them: what the other one says is saved is nothing. Negative
// control: judged by itself it saves much.
TEST(PathAllocation, IsJudgedByWhatDidNotChooseIt) {
    PathNoise chose = halves(1, 1), other = halves(1, 1);
    chose.variance[3 * side + 3] = 1e4;
    const auto counts = allocatePaths(chose, 16);
    EXPECT_LT(varianceSaved(other, counts, 16), 1);
    EXPECT_GT(varianceSaved(chose, counts, 16), 4) << "negative control";
}

FilmImage render(CameraSampling sampling, uint64_t seed, SamplingRule rule = SamplingRule::right) {
    RenderSettings settings;
    settings.photonsPerPass = 4000;
    settings.bdd = 1;
    settings.cameraPaths = 4;
    settings.cameraSampling = sampling;
    settings.seed = seed;
    settings.controlOptions += optionOf(rule);
    Renderer renderer(testDevice(), projectScene("cornell_phong.xml", {{"resolution", "32"}}), settings);
    constexpr unsigned passes = 12;
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    return renderer.develop();
}

double sumOf(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Mean over seeds of adaptive light over even light of the same seed, whose photons are the same.
MeanAndError ratioOf(unsigned component, SamplingRule rule) {
    std::vector<double> ratios;
    for (uint64_t seed = 1; seed <= 8; ++seed)
        ratios.push_back(sumOf(render(CameraSampling::adaptive, seed, rule).components[component].radiance) /
                         sumOf(render(CameraSampling::even, seed).components[component].radiance));
    return meanAndError(ratios);
}

// The same light whatever the paths of a pixel, of each class. Within 5 standard errors of eight seeds (Student's t,
// two-sided: 0.16 % a class, 0.3 % in all; the seeds are fixed, so a test that passes goes on passing). Negative
// control: the weight of an even number where the number differs.
TEST(PathAllocation, LeavesTheMean) {
    for (const unsigned component : {LIGHT_DIRECT, LIGHT_DIFFUSE}) {
        const MeanAndError right = ratioOf(component, SamplingRule::right);
        EXPECT_NEAR(right.mean, 1, 5 * right.standardError) << componentName(component);
    }
    const MeanAndError wrong = ratioOf(LIGHT_DIFFUSE, SamplingRule::fourEverywhere);
    EXPECT_GT(std::abs(wrong.mean - 1), 5 * wrong.standardError) << "negative control";
}

FilmImage renderLarge(CameraSampling sampling, uint64_t seed, unsigned paths) {
    RenderSettings settings;
    settings.bdd = 1;
    settings.photonsPerPass = 4000;
    settings.cameraPaths = paths;
    settings.cameraSampling = sampling;
    settings.seed = seed;
    Renderer renderer(testDevice(), projectScene("cornell_phong.xml", {{"resolution", "145"}}), settings);
    for (unsigned pass = 0; pass < 2; ++pass) renderer.renderPass(pass);
    if (sampling == CameraSampling::adaptive) {
        EXPECT_TRUE(renderer.countGathered()) << "its paths are those of the pass";
    }
    return renderer.develop();
}

// Blocks of several pixels, cut off at the edges of an image of 145 x 145: direct light of its right and lower quarter,
// as above (0.16 %).
TEST(PathAllocation, LeavesTheMeanInLargerImages) {
    std::vector<double> ratios;
    const auto cornerOf = [](const FilmImage& image) {
        double sum = 0;
        for (unsigned y = 73; y < 145; ++y)
            for (unsigned x = 73; x < 145; ++x)
                sum += image.components[LIGHT_DIRECT].radiance.at(3 * (size_t{y} * 145 + x));
        return sum;
    };
    for (uint64_t seed = 1; seed <= 8; ++seed)
        ratios.push_back(cornerOf(renderLarge(CameraSampling::adaptive, seed, 4)) /
                         cornerOf(renderLarge(CameraSampling::even, seed, 4)));
    const MeanAndError found = meanAndError(ratios);
    EXPECT_NEAR(found.mean, 1, 5 * found.standardError);
    EXPECT_LT(found.standardError, 0.03) << "or else a sixth of the light missing would not be seen";
}

// Nothing can be moved.
// Passes of several paths know what nets leave of the noise; but no more than the image has, and not too many in all.
TEST(PathAllocation, AProbeHasAsManyPathsAsItMay) {
    const auto costOfProbe = [](unsigned width, unsigned pathsByPixel) {
        shared::Camera camera{};
        camera.width = camera.height = width;
        return NoiseProbe::costByPixel(camera, pathsByPixel) * width * width;
    };
    constexpr double others = 22; // paths that it traces beside
    const double single = costOfProbe(32, 1) - others * 32 * 32;
    EXPECT_EQ(costOfProbe(32, 4) - others * 32 * 32, 4 * single);
    EXPECT_EQ(costOfProbe(32, 64) - others * 32 * 32, 16 * single);
    for (const unsigned width : {8u, 60u, 128u, 1000u, 4000u})
        for (const unsigned paths : {2u, 64u}) EXPECT_LE(costOfProbe(width, paths), 2 * (1 << 19) + others * 128 * 128);
}

TEST(PathAllocation, OnePathIsEven) {
    EXPECT_EQ(renderLarge(CameraSampling::adaptive, 1, 1).radiance, renderLarge(CameraSampling::even, 1, 1).radiance);
}

TEST(PathAllocation, SameSeedGivesTheSameBits) {
    const FilmImage first = render(CameraSampling::adaptive, 5), again = render(CameraSampling::adaptive, 5);
    EXPECT_EQ(first.radiance, again.radiance);
    EXPECT_NE(first.radiance, render(CameraSampling::adaptive, 6).radiance) << "control";
    EXPECT_NE(first.radiance, render(CameraSampling::even, 5).radiance) << "control";
}

Truth gaining(double variance, double time, double noiseOfPhotons = 0) {
    Truth truth;
    truth.samplingGain = {variance, time};
    truth.noiseOfPhotons = noiseOfPhotons;
    return truth;
}

constexpr Freedom ofSampling{.cameraPaths = true, .cameraSampling = true};

CameraSampling chosen(const Truth& truth, Freedom freedom = ofSampling) {
    const Found found = search([&](const RenderSettings&) { return truth; }, 60, freedom);
    EXPECT_EQ(found.report.rows[found.report.chosen].settings.cameraSampling, found.settings.cameraSampling);
    return found.settings.cameraSampling;
}

// 1.2 times less error at least, time counted; photons' noise is not lowered, and the probe is to take little of the
// time.
TEST(PathAllocation, IsChosenWhereItGains) {
    EXPECT_EQ(chosen(gaining(2, 1)), CameraSampling::adaptive);
    EXPECT_EQ(chosen(gaining(1.1, 1)), CameraSampling::even);
    EXPECT_EQ(chosen(gaining(2, 2)), CameraSampling::even);
    EXPECT_EQ(chosen(gaining(2, 1, 0.9)), CameraSampling::even);
    Truth dear = gaining(2, 1);
    dear.pathsOfSamplingGain = 1000;
    EXPECT_EQ(chosen(dear), CameraSampling::even);
    EXPECT_EQ(chosen(gaining(2, 1), {.cameraPaths = true}), CameraSampling::even) << "nothing was free";
}

TEST(PathAllocation, IsChosenInShortRendersToo) {
    Truth slow = gaining(2, 1);
    slow.secondsPerPass = 0.25;
    slow.shareOfPhotonSeconds = 0.8;
    const Found found = search([&](const RenderSettings&) { return slow; }, 5, ofSampling);
    EXPECT_EQ(found.settings.cameraSampling, CameraSampling::adaptive);
}

} // namespace
} // namespace quasilux
