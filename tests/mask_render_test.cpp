// Light through a partly transparent sheet or a thin pane, against its closed form: a lamp shines on it above a floor,
// and the camera looks at the floor from below, so that all light has passed it once.
// A right case passes within 3 standard errors of 10 batches (Student t, 1.5 % a case; seeds are fixed) plus 0.5 % for
// the density radius.
#include "support/pane_transmittance.h"
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/shared_features.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

constexpr double floorReflectance = 0.8, intensity = 10, height = 2;

const char* const grey = R"(<float name="opacity" value="0.25"/>)";
const char* const board = R"(<texture type="checkerboard" name="opacity"><float name="color0" value="0.25"/>
    <rgb name="color1" value="0.1,0.25,0.4"/></texture>)";

/// `aside`: how far the lamp stands from the point above what the camera sees.
Scene sheetScene(const std::string& bsdf, int maxDepth, double aside = 0, const char* integrator = "path") {
    return placedScene(orthographicSensor("0,0,0.5", "0,0,0", 0.05, 4) +
                           fmt::format(R"(
<integrator type="{}"><integer name="max_depth" value="{}"/></integrator>
<shape type="rectangle"><transform name="to_world"></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="{}"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="1"/></transform>
    {}</shape>
<emitter type="point"><rgb name="intensity" value="{}"/><transform name="to_world"><translate x="{}" z="{}"/></transform></emitter>)",
                                       integrator, maxDepth, floorReflectance, bsdf, intensity, aside, height),
                       Placement{});
}

MeanAndError renderScene(const Scene& scene, DirectLight direct, MapOrder map, unsigned photons) {
    RenderSettings settings;
    settings.direct = direct;
    settings.map = map;
    settings.photonsPerPass = photons;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.radiusScale = 0.5;
    return renderGroups(scene, settings, std::vector<int>(16, 0), 10, 12).front();
}

MeanAndError render(const std::string& opacity, DirectLight direct, int maxDepth = -1,
                    MapOrder map = MapOrder::photons) {
    const std::string black = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>)";
    return renderScene(sheetScene("<bsdf type=\"mask\">" + opacity + black + "</bsdf>", maxDepth), direct, map,
                       direct == DirectLight::photons ? 160'000 : 10'000);
}

const double seen = 0.75 * intensity / (height * height) * floorReflectance / std::numbers::pi;

double allowed(const MeanAndError& result) { return 3 * result.standardError + 0.005 * seen; }

class MaskedLight : public testing::TestWithParam<std::tuple<const char*, DirectLight, int>> {};
TEST_P(MaskedLight, HasTheClosedForm) {
    const auto& [opacity, direct, maxDepth] = GetParam();
    const auto result = render(opacity, direct, maxDepth);
    EXPECT_NEAR(result.mean, seen, allowed(result));
    EXPECT_LT(result.standardError, 0.01 * seen) << "too noisy to tell anything";
}
// Two segments are enough: passing the sheet begins none.
INSTANTIATE_TEST_SUITE_P(Masks, MaskedLight,
                         testing::Combine(testing::Values(grey, board),
                                          testing::Values(DirectLight::emitters, DirectLight::photons),
                                          testing::Values(-1, 2)));

TEST(MaskedLight, TheCameraMapHasIt) {
    const auto result = render(board, DirectLight::photons, -1, MapOrder::camera);
    EXPECT_NEAR(result.mean, seen, allowed(result));
}

TEST(MaskedLight, AnotherOpacityIsSeen) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto result = render(R"(<float name="opacity" value="0.31"/>)", direct);
        EXPECT_GT(std::abs(result.mean - seen), allowed(result)) << result.mean << " looks right";
    }
}

// --- a thin pane: passed by 1 - F', whose incidence at the lamp's place aside is 56 degrees ---

constexpr double aside = 3, paneIndex = 1.5;

/// Radiance of the floor.
double seenThrough(double transmittance) {
    const double distance = std::hypot(aside, height), cosine = height / distance;
    return transmittance * intensity * cosine / (distance * distance) * floorReflectance / std::numbers::pi;
}
const double slanted = test::paneTransmittance(height / std::hypot(aside, height), paneIndex);

MeanAndError renderPane(DirectLight direct, int maxDepth = -1, MapOrder map = MapOrder::photons,
                        const char* integrator = "path") {
    return renderScene(sheetScene(R"(<bsdf type="thindielectric"><float name="int_ior" value="1.5"/>
        <float name="ext_ior" value="1"/><rgb name="specular_reflectance" value="0"/></bsdf>)",
                                  maxDepth, aside, integrator),
                       direct, map, direct == DirectLight::photons ? 640'000 : 10'000);
}

class LightThroughAPane : public testing::TestWithParam<std::tuple<DirectLight, MapOrder, int>> {};
TEST_P(LightThroughAPane, HasTheClosedForm) {
    const auto& [direct, map, maxDepth] = GetParam();
    const auto result = renderPane(direct, maxDepth, map);
    const double bound = 3 * result.standardError + 0.005 * seenThrough(slanted);
    EXPECT_NEAR(result.mean, seenThrough(slanted), bound);
    // Negative control: what passes straight at it, 92 % and not 84 %.
    EXPECT_GT(std::abs(result.mean - seenThrough(test::paneTransmittance(1, paneIndex))), bound)
        << result.mean << " looks right";
}
// The pane begins a segment, as in Mitsuba's `path`.
INSTANTIATE_TEST_SUITE_P(Panes, LightThroughAPane,
                         testing::Values(std::tuple{DirectLight::emitters, MapOrder::photons, -1},
                                         std::tuple{DirectLight::emitters, MapOrder::photons, 3},
                                         std::tuple{DirectLight::photons, MapOrder::photons, 3},
                                         std::tuple{DirectLight::photons, MapOrder::camera, -1}));

TEST(LightThroughAPane, IsDirectLight) {
    EXPECT_LT(renderPane(DirectLight::emitters).standardError, 1e-3 * seenThrough(slanted)) << "photons would be noisy";
}

TEST(LightThroughAPane, IsMissingWhereItsSegmentIsOneTooMany) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) EXPECT_EQ(renderPane(direct, 2).mean, 0);
}

TEST(LightThroughAPane, BeginsNoSegmentInIntegratorsOfVolumes) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto result = renderPane(direct, 2, MapOrder::photons, "volpath");
        EXPECT_NEAR(result.mean, seenThrough(slanted), 3 * result.standardError + 0.005 * seenThrough(slanted));
    }
}

} // namespace
} // namespace quasilux
