// Density radius by pixel: the choice against its closed form, from films made by hand, and its effect on a render.
//
// Nothing here is left to chance: the films are computed, and the renders have fixed seeds.
#include "bench/bench_run.h"
#include "compare/measures.h"
#include "render/adaptive_radius.h"
#include "render/pass_program.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

const FilmLayout layout;
constexpr unsigned width = 32, height = 8, passes = 16;
constexpr double noiseToCurvature = 0.4, squaredRadii = 20, inverseSquares = 14;

/// Of the light in a pixel, relative to its radiance: bias at radius 1, and its variance in one pass of radius 1.
struct Light {
    double curvature, variance;
};

// A film whose sums say just this, of radiance `radiance`: the mean of the bias by its squared radii, the scatter of
// single passes by their inverse; the estimate of bias has 1.6 times the image's variance.
void put(std::vector<float>& film, unsigned pixel, const Light& light, double radiance) {
    float* sums = film.data() + size_t(pixel) * layout.floatsPerPixel();
    const double mean = radiance * light.curvature * squaredRadii / passes;
    const double scatter = 1.6 * radiance * radiance * light.variance * inverseSquares / passes; // of a pass
    for (unsigned channel = 0; channel < 3; ++channel) {
        sums[FILM_TOTAL_SUM + channel] = static_cast<float>(radiance * passes);
        float* bias = sums + FILM_CLASS_BIAS(layout.bits()) + LIGHT_DIFFUSE * FILM_BIAS_FLOATS;
        bias[FILM_BIAS_SUM + channel] = static_cast<float>(mean * passes);
        bias[FILM_BIAS_SQUARES + channel] = static_cast<float>(passes * mean * mean + (passes - 1) * scatter);
    }
}

/// What the kernels make of a film.
struct Choice {
    std::vector<float> scales, coarseScales, film;
};

Choice choose(const std::vector<float>& film, double largest = 2) {
    Program program(testDevice(), "adaptive_radius.cl", radiusOptions(1u << LIGHT_DIFFUSE));
    Buffer<float> sums(testDevice(), film, "film"), scales(testDevice(), size_t{width} * height, "scales");
    Buffer<float> before(testDevice(), size_t{width} * height, "scales before");
    Buffer<shared::RadiusMeasure> measures(testDevice(), size_t{width} * height, "measures");
    Buffer<float> coarseScales(testDevice(), size_t{width} * height, "coarse scales");
    before.fill(1);
    coarseScales.fill(static_cast<float>(largest));
    measures.write(std::vector<shared::RadiusMeasure>(measures.size()));
    const shared::RadiusParams params{width,
                                      height,
                                      passes,
                                      passes,
                                      static_cast<float>(squaredRadii / (largest * largest)),
                                      static_cast<float>(inverseSquares * largest * largest),
                                      noiseToCurvature,
                                      static_cast<float>(largest)};
    program.kernel("measureRadii").launch(size_t{width} * height, sums, coarseScales, measures, params);
    program.kernel("chooseRadii").launch(size_t{width} * height, sums, measures, coarseScales, before, scales, params);
    return {scales.read(), coarseScales.read(), sums.read()};
}

std::vector<float> chooseRadii(const std::vector<float>& film, double largest = 2) {
    return choose(film, largest).scales;
}

// docs/method/radius.md: r^6 = N v / (2 * 3 c^2), with c^2 net of the noise of its estimate, and not below a tenth of
// it.
double bestRadius(const Light& light) {
    const double noise =
        3 * 1.6 * light.variance * inverseSquares / passes / passes * std::pow(passes / squaredRadii, 2);
    const double net = 3 * light.curvature * light.curvature - noise;
    return std::pow(noiseToCurvature * 3 * light.variance / (2 * 3 * std::max(net, 0.1 * noise)), 1.0 / 6);
}

TEST(AdaptiveRadius, BalancesNoiseAndBias) {
    const Light left{0.1, 0.01}, right{0.02, 0.002};
    std::vector<float> film(size_t{width} * height * layout.floatsPerPixel());
    for (unsigned pixel = 0; pixel < width * height; ++pixel)
        put(film, pixel, pixel % width < width / 2 ? left : right,
            pixel % 3 + 0.5); // relative: brightness is none of it
    const auto scales = chooseRadii(film);
    for (unsigned y = 0; y < height; ++y) {
        EXPECT_NEAR(scales[y * width + 4], bestRadius(left), 1e-3);
        EXPECT_NEAR(scales[y * width + width - 4], bestRadius(right), 1e-3);
    }
    EXPECT_GT(bestRadius(right), 1.2 * bestRadius(left)); // else the test could not tell them apart
}

TEST(AdaptiveRadius, IsBoundedAndNeedsLight) {
    std::vector<float> film(size_t{width} * height * layout.floatsPerPixel());
    for (unsigned pixel = 0; pixel < width * height; ++pixel)
        if (pixel % width < 10)
            put(film, pixel, {0, 0.01}, 1); // no bias in sight
        else if (pixel % width < 20)
            put(film, pixel, {100, 0.01}, 1);
    const auto scales = chooseRadii(film, 1.5);
    EXPECT_FLOAT_EQ(scales[3], 1.5f);
    EXPECT_FLOAT_EQ(scales[15], 0.1f);
    EXPECT_FLOAT_EQ(scales[28], 1); // black: as it was
}

// The coarse camera's disc follows the radius that is chosen where it is sure of the bias, and what it measured with
// wider discs is forgotten.
TEST(AdaptiveRadius, DiscsNarrowWhereBiasIsCertain) {
    const Light certain{0.5, 0.001}, uncertain{0.1, 0.2};
    std::vector<float> film(size_t{width} * height * layout.floatsPerPixel());
    for (unsigned pixel = 0; pixel < width * height; ++pixel)
        put(film, pixel, pixel % width < width / 2 ? certain : uncertain, 1);
    const Choice choice = choose(film);
    const auto biasSum = [&](unsigned pixel) {
        return choice.film[size_t(pixel) * layout.floatsPerPixel() + FILM_CLASS_BIAS(layout.bits()) +
                           LIGHT_DIFFUSE * FILM_BIAS_FLOATS];
    };
    EXPECT_LT(choice.scales[4], 0.5);
    EXPECT_LT(choice.coarseScales[4], 0.6);
    EXPECT_EQ(biasSum(4), 0);
    EXPECT_LT(choice.scales[width - 4], 2);
    EXPECT_EQ(choice.coarseScales[width - 4], 2);
    EXPECT_GT(biasSum(width - 4), 0);
}

double relativeError(const RenderSettings& settings, unsigned passesOfRender) {
    static const RadianceImage reference =
        readRadiance(std::string(QUASILUX_SOURCE_DIR) + "/tests/data/cornell_phong_64.exr");
    Renderer renderer(testDevice(), projectScene("cornell_phong.xml", {{"resolution", "64"}}), settings);
    for (unsigned pass = 0; pass < passesOfRender; ++pass) renderer.renderPass(pass);
    return compareImages(radianceOf(renderer.develop()), reference, {wholePicture(64, 64)}, {}).regions.at(0).relMse;
}

// Of a pass's cost it is known apart, since it ends after 16 passes.
TEST(AdaptiveRadius, IsCountedApartFromThePasses) {
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    const Scene scene = projectScene("cornell_phong.xml", {{"resolution", "32"}});
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 20; ++pass) {
        const double before = renderer.counters().radiusSeconds;
        renderer.renderPass(pass);
        EXPECT_EQ(renderer.counters().radiusSeconds > before, pass < 16) << pass;
    }
    EXPECT_EQ(renderer.counters().radiusPaths, 16u * 32 * 32);
    EXPECT_LT(renderer.counters().radiusSeconds, renderer.counters().renderSeconds);
}

// Each of the fixed radii that the choice ranges over is worse in the whole image.
TEST(AdaptiveRadius, HasLessErrorThanAnyFixedRadius) {
    RenderSettings settings;
    settings.photonsPerPass = 100'000;
    const double adaptive = relativeError(settings, 64);
    settings.radius = RadiusChoice::fixed;
    for (const double scale : {0.3, 1.0, 2.0}) {
        settings.radiusScale = scale;
        EXPECT_LT(1.1 * adaptive, relativeError(settings, 64)) << "fixed radius times " << scale;
    }
}

} // namespace
} // namespace quasilux
