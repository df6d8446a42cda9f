// Readings of meters by one method or another, held against closed forms.
#pragma once

#include "render/renderer.h"
#include "support/meter_scenes.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {

/// Allowed for the radius of a density estimate; and how well a test must know its reading. Relative.
constexpr double densityBias = 0.003, knownTo = 0.0035;

/// How to render.
struct Method {
    const char* name;
    unsigned bdd = 0;
    const char* quasiSpecular = "auto";
    DirectLight direct = DirectLight::emitters;
    Variant variant = Variant::main;
    MapOrder map = MapOrder::photons;
    test::LawRule rule = test::LawRule::right;
};

struct Reading {
    double value, standardError;
};

inline Reading measure(const Scene& scene, const Method& method, unsigned passes, unsigned photons = 20000) {
    RenderSettings settings;
    settings.bdd = method.bdd;
    settings.quasiSpecular = method.quasiSpecular;
    settings.quasiSpecularOverridesScene = settings.quasiSpecular != "auto";
    settings.direct = method.direct;
    settings.variant = method.variant;
    settings.map = method.map;
    settings.controlOptions += optionOf(method.rule);
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = photons;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    EXPECT_EQ(renderer.counters().nonFinite, 0u);
    EXPECT_EQ(renderer.counters().overflows, 0u);
    const FilmImage image = renderer.develop();
    return {image.radiance[0], image.standardError[0]};
}

/// `biased`: a density estimate takes part.
inline bool agrees(const Reading& reading, double truth, bool biased) {
    const double rounding = 4e-6 * truth; // of single precision: readings of direct light have less noise
    return std::abs(reading.value - truth) <= 3 * reading.standardError + (biased ? densityBias * truth : 0) + rounding;
}

inline void expectReading(const Scene& scene, const Method& method, double truth, bool biased, unsigned passes,
                          unsigned photons = 20000) {
    const Reading reading = measure(scene, method, passes, photons);
    EXPECT_TRUE(agrees(reading, truth, biased))
        << reading.value << " +- " << reading.standardError << ", expected " << truth;
    EXPECT_LT(reading.standardError, knownTo * truth) << "too noisy to decide anything";
    EXPECT_FALSE(agrees(reading, truth / 1.02, biased)) << "a light that is 2 % too strong would pass";
}

} // namespace quasilux
