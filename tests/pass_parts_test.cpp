// Photons of a pass that do not fit into the device's memory come in several parts: the image, its error, what meters
// read and what is counted are those of one.
//
// False alarms are stated at each test; seeds are fixed, so what passes goes on passing.
#include "render/pass_part.h"
#include "support/meter_scenes.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace quasilux {
namespace {

using test::optionOf, test::PartsRule;

constexpr unsigned photons = 12'000, resolution = 32;

RenderSettings settingsOf(unsigned ofPass, uint64_t seed = 1, PartsRule rule = PartsRule::right) {
    RenderSettings settings;
    settings.photonsPerPass = ofPass;
    settings.seed = seed;
    settings.energyBalance = true;
    settings.emission = Emission::plain;
    settings.controlOptions = optionOf(rule);
    return settings;
}

Scene box() { return projectScene("cornell_phong.xml", {{"resolution", std::to_string(resolution)}}); }

struct Rendered {
    FilmImage image;
    RenderCounters counters;
    uint64_t bytes = 0, photonBytes = 0;
};

Rendered render(Device& device, const Scene& scene, const RenderSettings& settings, unsigned passes) {
    Renderer renderer(device, scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    Rendered result{renderer.develop(), renderer.counters(), 0, 0};
    for (const auto& [label, bytes] : renderer.report().bufferBytes) {
        result.bytes += bytes;
        if (label == "photons") result.photonBytes = bytes;
    }
    EXPECT_EQ(result.bytes, renderer.report().forecast.deviceBytes);
    return result;
}

/// With room for two fifths of the photons.
Device& smallDevice() {
    static const uint64_t limit = [] {
        const Rendered all = render(testDevice(), box(), settingsOf(photons), 1);
        return all.bytes - all.photonBytes * 6 / 10;
    }();
    static Device device(-1, testDevice().workGroupSize(), limit);
    return device;
}

unsigned partsOf(const Rendered& rendered) {
    return static_cast<unsigned>(rendered.counters.cameraPaths /
                                 (uint64_t{resolution} * resolution * rendered.counters.passes));
}

double meanOf(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

// The direct light of three passes is that of their parts' camera paths, so the mean of three passes with each part's
// seed, but for rounding. Nothing is left to chance. Controls: parts of one seed; parts whose random numbers are those
// of later passes, so that passes of a device with more room, added to these, would repeat them.
TEST(PassParts, HaveCameraPathsOfTheirOwn) {
    const Rendered parts = render(smallDevice(), box(), settingsOf(photons), 3);
    const unsigned count = partsOf(parts);
    EXPECT_GE(count, 2u);
    EXPECT_LE(count, 6u);
    EXPECT_LE(parts.bytes, smallDevice().info().globalMemory);
    EXPECT_EQ(parts.counters.photonsEmitted, uint64_t{3} * count * ((photons + count - 1) / count));
    const auto directOf = [](const Rendered& rendered) {
        const auto& radiance = rendered.image.components[LIGHT_DIRECT].radiance;
        return std::vector<double>(radiance.begin(), radiance.end());
    };
    const auto ofSeed = [&](uint64_t seed, unsigned passes) {
        return render(testDevice(), box(), settingsOf(photons, seed), passes);
    };
    std::vector<double> mean(directOf(parts).size(), 0);
    for (unsigned number = 0; number < count; ++number) {
        const Rendered alone = ofSeed(PassPart{number, count}.seedOf(1), 3);
        EXPECT_EQ(partsOf(alone), 1u);
        const std::vector<double> direct = directOf(alone);
        for (size_t k = 0; k < mean.size(); ++k) mean[k] += direct[k] / count;
    }
    const auto largestDifference = [a = directOf(parts)](const std::vector<double>& b) {
        double largest = 0;
        for (size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]) / (0.01 + b[k]));
        return largest;
    };
    EXPECT_LT(largestDifference(mean), 1e-5);
    EXPECT_GT(largestDifference(directOf(ofSeed(1, 3))), 0.01) << "control";
    EXPECT_GT(largestDifference(directOf(ofSeed(1, 3 * count))), 0.01) << "control";
}

/// Of the diffuse light in images of several seeds: its mean, the standard error of that, and the variance of pixels as
/// it is found and as it is estimated.
struct Scatter {
    double mean = 0, standardError = 0, found = 0, estimated = 0;
};

Scatter scatterOf(Device& device, PartsRule rule, unsigned passes) {
    constexpr unsigned seeds = 12;
    std::vector<double> sums, squares, means;
    Scatter scatter;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        const RadianceEstimate image =
            render(device, box(), settingsOf(photons, seed, rule), passes).image.components[LIGHT_DIFFUSE];
        sums.resize(image.radiance.size());
        squares.resize(image.radiance.size());
        means.push_back(meanOf(image.radiance));
        for (size_t k = 0; k < sums.size(); ++k) {
            sums[k] += image.radiance[k];
            squares[k] += double(image.radiance[k]) * image.radiance[k];
            scatter.estimated += double(image.standardError[k]) * image.standardError[k] / seeds;
        }
    }
    for (size_t k = 0; k < sums.size(); ++k) scatter.found += (squares[k] - sums[k] * sums[k] / seeds) / (seeds - 1);
    const MeanAndError mean = meanAndError(means);
    scatter.mean = mean.mean;
    scatter.standardError = mean.standardError;
    return scatter;
}

// Single passes and batches of four, of which the last is open; radii by pixel have been chosen. The means of 12 seeds
// each differ by less than 5 of their standard errors (a false alarm in 5,000 runs, by Student's t). Variances found in
// 12 images scatter by some 10 %; what passes have in common makes estimates too high, never by half.
TEST(PassParts, HaveTheMeanAndTheErrorOfOne) {
    constexpr unsigned passes = 22;
    const Scatter parts = scatterOf(smallDevice(), PartsRule::right, passes),
                  one = scatterOf(testDevice(), PartsRule::right, passes),
                  wrong = scatterOf(smallDevice(), PartsRule::lastAlone, passes);
    const double error = std::hypot(parts.standardError, one.standardError);
    EXPECT_LT(error, 0.006 * one.mean) << "too little to know";
    EXPECT_NEAR(parts.mean, one.mean, 5 * error);
    // The parts' camera paths, of which there are more, lower it.
    EXPECT_LT(parts.found, 1.3 * one.found);
    EXPECT_GT(parts.found, 0.3 * one.found);
    EXPECT_NEAR(parts.found / parts.estimated, 1, 0.5);
    EXPECT_NEAR(one.found / one.estimated, 1, 0.5);
    EXPECT_LT(wrong.found / wrong.estimated, 0.3) << "negative control";
}

// All of the light of a lamp arrives, and its energy is counted once, whatever the parts.
TEST(PassParts, CarryTheFluxOfAPass) {
    const Rendered parts = render(smallDevice(), box(), settingsOf(photons), 3),
                   one = render(testDevice(), box(), settingsOf(photons), 3);
    ASSERT_GE(partsOf(parts), 2u);
    EXPECT_NEAR(parts.counters.energy->emitted / one.counters.energy->emitted, 1, 1e-4);
    EXPECT_NEAR(parts.counters.energy->imbalance(), 0, 1e-5);
    EXPECT_EQ(parts.counters.fluxEmitted, one.counters.fluxEmitted);
}

// A meter in a room whose walls are split, where photons are gathered and counted (irradiance_test.cpp): pi times the
// emission over the absorption. A pass of it is known to some 2 %, so the mean of 24 in parts to 0.4 %, and a false
// alarm comes less than once in 10^4 runs.
TEST(PassParts, AreOneForMeters) {
    std::array<std::string, 6> walls;
    walls.fill(test::splitWall(0.6) + test::areaLight(1));
    walls[0] += test::irradiancemeter();
    const Scene scene = test::meterScene(test::unitRoom(walls));
    RenderSettings settings = settingsOf(8000);
    settings.direct = DirectLight::photons;
    const Rendered all = render(testDevice(), scene, settings, 1);
    Device small(-1, testDevice().workGroupSize(), all.bytes - all.photonBytes * 6 / 10);
    const Rendered parts = render(small, scene, settings, 24);
    EXPECT_GE(parts.counters.cameraPaths, 2 * 24 * all.counters.cameraPaths);
    constexpr double truth = std::numbers::pi * 2.5;
    EXPECT_NEAR(meanOf(parts.image.radiance), truth, 0.02 * truth);
    EXPECT_LT(meanOf(parts.image.standardError), 0.005 * truth);
    EXPECT_GT(meanOf(parts.image.standardError), 1e-5 * truth);
}

} // namespace
} // namespace quasilux
