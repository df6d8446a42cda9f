// A ball whose blend is half glass and half diffuse, in surroundings of radiance 1, against its closed form
// (docs/notes/validation.md#a-ball-that-is-half-glass-and-half-diffuse). A right case passes within 3.5 standard errors of
// 10 batches (Student t, 0.7 %; seeds are fixed).
#include "support/path_tracing.h"
#include "support/placed_scenes.h"
#include "support/render_statistics.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

constexpr double index = 1.5;

/// Fresnel's reflectance from inside, at this cosine.
double reflectanceInside(double cosInside) {
    const double sine = index * std::sqrt(1 - cosInside * cosInside);
    if (sine >= 1) return 1;
    const double cosOutside = std::sqrt(1 - sine * sine);
    const double s = (cosOutside - index * cosInside) / (cosOutside + index * cosInside),
                 p = (index * cosOutside - cosInside) / (index * cosOutside + cosInside);
    return (s * s + p * p) / 2;
}

/// Of the middle of the ball, seen from afar.
double radianceOfMiddle(double reflectance) {
    constexpr int steps = 100000; // of the square of the cosine
    double ofSurroundings = 0, ofInside = 0;
    for (int k = 0; k < steps; ++k) {
        const double f = reflectanceInside(std::sqrt((k + 0.5) / steps));
        ofSurroundings += (1 - f) / 2 / (1 - f / 2) / steps;
        ofInside += 0.5 / (1 - f / 2) / steps;
    }
    const double inside = ofSurroundings / (1 - reflectance * ofInside), f = reflectanceInside(1);
    const double chord = ((1 - f) / 2 + reflectance * inside / 2) / (1 - f / 2);
    return (f + (1 - f) * chord) / 2 + reflectance / 2;
}

MeanAndError render(double reflectance) {
    const Scene scene = placedScene(orthographicSensor("0,0,3", "0,0,0", 0.05, 4) + fmt::format(R"(
<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
<shape type="sphere"><bsdf type="blendbsdf"><float name="weight" value="0.5"/>
    <bsdf type="dielectric"><float name="int_ior" value="{}"/><float name="ext_ior" value="1"/></bsdf>
    <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="{}"/></bsdf></bsdf></bsdf></shape>)",
                                                                                                index, reflectance),
                                    Placement{});
    RenderSettings settings = pathTracing();
    settings.cameraPaths = 64;
    return renderGroups(scene, settings, std::vector<int>(16, 0), 10, 8).front();
}

TEST(BlendedGlass, HasTheClosedForm) {
    EXPECT_NEAR(radianceOfMiddle(1), 1, 1e-6);
    for (const double reflectance : {1.0, 0.5, 0.0}) {
        SCOPED_TRACE(reflectance);
        const auto result = render(reflectance);
        EXPECT_NEAR(result.mean, radianceOfMiddle(reflectance), 3.5 * result.standardError + 1e-5);
        EXPECT_LT(result.standardError, 0.003);
    }
}

// Negative control: light that is 1.5 % less, as a renderer may have it that loses some within the ball.
TEST(BlendedGlass, OtherLightIsSeen) {
    const auto result = render(0.5);
    EXPECT_GT(std::abs(result.mean - 0.985 * radianceOfMiddle(0.5)), 3.5 * result.standardError);
}

} // namespace
} // namespace quasilux
