// Same device, same seed: the same bits, whatever the scheduling. That parts of a render merge to the whole:
// checkpoint_test.
#include "support/render_statistics.h"
#include "support/test_kernels.h"

#include "device/device.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>

namespace quasilux {
namespace {

Scene smallCornell() { return projectScene("cornell_phong.xml", {{"resolution", "32"}}); }

RenderSettings smallSettings(DirectLight direct = DirectLight::emitters) {
    RenderSettings settings;
    settings.photonsPerPass = 20'000;
    settings.direct = direct;
    settings.bdd = 1;
    return settings;
}

FilmImage renderThese(const std::vector<unsigned>& passes, const RenderSettings& settings,
                      unsigned workGroupSize = 64) {
    Renderer renderer(testDevice(workGroupSize), smallCornell(), settings);
    for (const unsigned pass : passes) renderer.renderPass(pass);
    return renderer.develop();
}

FilmImage renderPasses(unsigned first, unsigned last, const RenderSettings& settings, unsigned workGroupSize = 64) {
    std::vector<unsigned> passes(last - first);
    std::iota(passes.begin(), passes.end(), first);
    return renderThese(passes, settings, workGroupSize);
}

RenderSettings fixedRadius() {
    auto settings = smallSettings();
    settings.radius = RadiusChoice::fixed;
    return settings;
}

// Bits, not values: a NaN must show.
void expectSameBits(const FilmImage& a, const FilmImage& b) {
    const auto same = [](const std::vector<float>& x, const std::vector<float>& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(float)) == 0;
    };
    EXPECT_TRUE(same(a.radiance, b.radiance));
    EXPECT_TRUE(same(a.standardError, b.standardError));
    EXPECT_TRUE(same(a.bias, b.bias));
    EXPECT_TRUE(same(a.biasError, b.biasError));
    for (size_t k = 0; k < a.components.size(); ++k)
        EXPECT_TRUE(same(a.components[k].radiance, b.components[k].radiance));
}

TEST(Determinism, TwoRunsGiveTheSameBits) {
    expectSameBits(renderPasses(0, 3, smallSettings()), renderPasses(0, 3, smallSettings()));
    const auto photons = smallSettings(DirectLight::photons);
    expectSameBits(renderPasses(0, 3, photons), renderPasses(0, 3, photons));
}

TEST(Determinism, RadiiByPixelAreTheSameBits) {
    expectSameBits(renderPasses(0, 12, smallSettings()), renderPasses(0, 12, smallSettings(), 7));
    EXPECT_NE(renderPasses(0, 12, smallSettings()).radiance, renderPasses(0, 12, fixedRadius()).radiance);
}

TEST(Determinism, WorkGroupSizeDoesNotMatter) {
    const auto expected = renderPasses(0, 3, smallSettings(), 64);
    for (const unsigned size : {1u, 7u, 32u, 256u}) expectSameBits(expected, renderPasses(0, 3, smallSettings(), size));
}

// Shorter regions, more blocks of cells, functions with a definition of their own to link: the same passes, in another
// order of sums.
TEST(Determinism, WorkDividedAsForAGpuGivesTheSameImage) {
    if (!Device(0).info().isCpu) GTEST_SKIP() << "the device is a GPU: its work is divided so already";
    const auto render = [](MapOrder map, bool asForGpu) {
        auto settings = smallSettings();
        settings.map = map;
        Device device(0);
        if (asForGpu) device.divideAsForGpu();
        Renderer renderer(device, smallCornell(), settings);
        for (unsigned pass = 0; pass < 3; ++pass) renderer.renderPass(pass);
        return std::pair{renderer.develop(), renderer.report().bufferBytes.at("photon regions")};
    };
    for (const MapOrder map : {MapOrder::photons, MapOrder::camera}) {
        const auto [expected, regions] = render(map, false);
        const auto [found, regionsForGpu] = render(map, true);
        EXPECT_GT(regionsForGpu, 4 * regions) << "control: it was divided in the same way";
        double difference = 0, sum = 0;
        for (size_t k = 0; k < expected.radiance.size(); ++k) {
            difference += std::abs(double(found.radiance[k]) - double(expected.radiance[k]));
            sum += double(expected.radiance[k]);
        }
        EXPECT_LT(difference, 1e-5 * sum);
    }
}

// Beside the image, not in it: the estimate of bias changes no bit of what was there without it. Radii by pixel are
// chosen from it, so one for all.
TEST(Determinism, EstimatingTheBiasDoesNotChangeTheImage) {
    auto with = smallSettings();
    with.radius = RadiusChoice::fixed;
    auto without = with;
    without.estimateBias = false;
    const auto plain = renderPasses(0, 3, without), estimated = renderPasses(0, 3, with);
    EXPECT_EQ(plain.radiance, estimated.radiance);
    EXPECT_EQ(plain.standardError, estimated.standardError);
    EXPECT_TRUE(plain.bias.empty());
    EXPECT_NE(estimated.bias, std::vector<float>(estimated.bias.size()));
}

// Negative control: the comparison sees another seed.
TEST(Determinism, AnotherSeedGivesAnotherImage) {
    auto other = smallSettings();
    other.seed = 2;
    EXPECT_NE(renderPasses(0, 3, smallSettings()).radiance, renderPasses(0, 3, other).radiance);
}

void expectSameMeans(const FilmImage& a, const FilmImage& b) {
    ASSERT_EQ(a.radiance.size(), b.radiance.size());
    for (size_t k = 0; k < a.radiance.size(); ++k) {
        const float unit = std::nextafter(std::abs(b.radiance[k]), INFINITY) - std::abs(b.radiance[k]);
        EXPECT_LE(std::abs(a.radiance[k] - b.radiance[k]), unit) << "value " << k;
    }
}

// A pass is a function of its number and the seed: radii by pixel, which earlier passes decide, are found whether or
// not these have been rendered.
TEST(Determinism, PassesInAnyOrderGiveTheSameMean) {
    std::vector<unsigned> forwards(18); // radii are chosen after 2, 4, 8, 16
    std::iota(forwards.begin(), forwards.end(), 0u);
    const std::vector<unsigned> backwards(forwards.rbegin(), forwards.rend());
    expectSameMeans(renderThese(forwards, smallSettings()), renderThese(backwards, smallSettings()));
    // Negative control: late passes with the radii of the first ones are seen to differ.
    EXPECT_NE(renderPasses(5, 10, smallSettings()).radiance, renderPasses(5, 10, fixedRadius()).radiance);
}

// Nothing is lost or dropped on the way: no sample was not finite, no path was cut.
TEST(Determinism, NoSampleIsDropped) {
    Device device(0);
    Renderer renderer(device, smallCornell(), smallSettings());
    for (unsigned pass = 0; pass < 3; ++pass) renderer.renderPass(pass);
    EXPECT_EQ(renderer.counters().nonFinite, 0u);
    EXPECT_EQ(renderer.counters().cutPaths, 0u);
    EXPECT_EQ(renderer.counters().photonsEmitted, 60'000u);
}

} // namespace
} // namespace quasilux
