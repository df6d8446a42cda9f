// Light through a partly transparent sheet or a thin pane, against its closed form: a lamp shines on it above a floor,
// and the camera looks at the floor from below, so that all light has passed it once.
// A right case passes within 3 standard errors of 10 batches (Student t, 1.5 % a case; seeds are fixed) plus 0.5 % for
// the density radius.
#include "support/pane_transmittance.h"
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/shared_features.h"
#include "support/wrong_rules.h"

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

/// `aside`: how far the lamp stands from the point above what the camera sees. From 1 on it looks through the sheet.
Scene sheetScene(const std::string& bsdf, int maxDepth, double aside = 0, const char* integrator = "path",
                 double cameraHeight = 0.5) {
    return placedScene(orthographicSensor(fmt::format("0,0,{}", cameraHeight), "0,0,0", 0.05, 4) +
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

const char* const black = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>)";

std::string mask(const std::string& opacity) { return "<bsdf type=\"mask\">" + opacity + black + "</bsdf>"; }

MeanAndError render(const Scene& scene, DirectLight direct, MapOrder map = MapOrder::photons) {
    return renderScene(scene, direct, map, direct == DirectLight::photons ? 160'000 : 10'000);
}

MeanAndError render(const std::string& opacity, DirectLight direct, int maxDepth = -1,
                    MapOrder map = MapOrder::photons) {
    return render(sheetScene(mask(opacity), maxDepth), direct, map);
}

const double seen = 0.75 * intensity / (height * height) * floorReflectance / std::numbers::pi;

double allowed(const MeanAndError& result, double truth = seen) { return 3 * result.standardError + 0.005 * truth; }

class MaskedLight : public testing::TestWithParam<std::tuple<const char*, DirectLight, int>> {};
TEST_P(MaskedLight, HasTheClosedForm) {
    const auto& [opacity, direct, maxDepth] = GetParam();
    const auto result = render(opacity, direct, maxDepth);
    EXPECT_NEAR(result.mean, seen, allowed(result));
    EXPECT_LT(result.standardError, 0.01 * seen) << "too noisy to tell anything";
}
// Three segments are enough: passing the sheet begins one, as in Mitsuba's `path`.
INSTANTIATE_TEST_SUITE_P(Masks, MaskedLight,
                         testing::Combine(testing::Values(grey, board),
                                          testing::Values(DirectLight::emitters, DirectLight::photons),
                                          testing::Values(-1, 3)));

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

// --- passages and max_depth: Mitsuba's values, by its own images of such scenes (docs/notes/validation.md) ---

/// What lets light pass, and how much of it.
struct Sheet {
    const char* name;
    std::string bsdf;
    double share;
};
const Sheet sheets[] = {{"Mask", mask(grey), 0.75},
                        {"Null", R"(<bsdf type="null"/>)", 1},
                        {"BlendWithNull",
                         std::string(R"(<bsdf type="blendbsdf"><float name="weight" value="0.75"/>)") + black +
                             R"(<bsdf type="null"/></bsdf>)",
                         0.75}};

class Passages : public testing::TestWithParam<Sheet> {
protected:
    /// The sheet between lamp and floor, or before the camera as well, by all three ways of light.
    void expectLight(bool isTwice, int maxDepth, double share, const char* integrator = "path") const {
        const double truth = share * seen / 0.75;
        for (const auto& [direct, map] :
             {std::pair{DirectLight::emitters, MapOrder::photons}, std::pair{DirectLight::photons, MapOrder::photons},
              std::pair{DirectLight::photons, MapOrder::camera}}) {
            const unsigned photons = direct == DirectLight::photons && share > 0 ? 160'000 : 10'000;
            const auto result = renderScene(scene(isTwice, maxDepth, integrator), direct, map, photons);
            EXPECT_NEAR(result.mean, truth, share == 0 ? 0 : allowed(result, truth))
                << integrator << ", max_depth " << maxDepth << ", direct " << static_cast<int>(direct) << ", map "
                << static_cast<int>(map);
        }
    }
    static Scene scene(bool isTwice, int maxDepth, const char* integrator = "path") {
        return sheetScene(GetParam().bsdf, maxDepth, 0, integrator, isTwice ? 1.5 : 0.5);
    }
};
TEST_P(Passages, BeginASegmentInPath) {
    expectLight(false, 2, 0);
    expectLight(true, 4, GetParam().share * GetParam().share);
    expectLight(true, 3, 0);
}
TEST_P(Passages, BeginNoneInVolpath) { expectLight(true, 2, GetParam().share * GetParam().share, "volpath"); }
// Negative control: without counting, light comes that must be missing, by camera paths, shadow rays and photons.
TEST_P(Passages, AreFoundWhereTheyDoNotCount) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        Scene wrong = scene(true, 3);
        wrong.countsPassages = false;
        EXPECT_GT(render(wrong, direct).mean, 0.5 * GetParam().share * GetParam().share * seen);
    }
}

/// What the camera sees of a lamp, or of surroundings, behind the sheet.
double behind(const Sheet& sheet, const std::string& emitter, const std::string& integrator) {
    const Scene scene = placedScene(orthographicSensor("0,0,0.5", "0,0,1", 0.05, 4) + integrator + R"(
<shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="1"/></transform>)" +
                                        sheet.bsdf + "</shape>" + emitter,
                                    Placement{});
    return render(scene, DirectLight::emitters).mean;
}
const char* const lamp = R"(<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/>
    <translate z="2"/></transform>)"
                         R"(<emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)";
const char* const sky = R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)";

std::string limit(const char* type, int maxDepth, bool hides = false) {
    return fmt::format(R"(<integrator type="{}"><integer name="max_depth" value="{}"/>
        <boolean name="hide_emitters" value="{}"/></integrator>)",
                       type, maxDepth, hides ? "true" : "false");
}

TEST_P(Passages, BeginASegmentBeforeEmittersThatAreSeen) {
    const double share = GetParam().share;
    for (const char* emitter : {lamp, sky}) {
        EXPECT_EQ(behind(GetParam(), emitter, limit("path", 1)), 0);
        EXPECT_NEAR(behind(GetParam(), emitter, limit("path", 2)), share, 1e-5);
        EXPECT_NEAR(behind(GetParam(), emitter, limit("volpath", 1)), share, 1e-5);
        EXPECT_NEAR(behind(GetParam(), emitter, R"(<integrator type="direct"/>)"), share, 1e-5);
    }
}

TEST_P(Passages, EndHidingAsInMitsuba) {
    const double share = GetParam().share;
    const std::string direct = R"(<integrator type="direct"><boolean name="hide_emitters" value="true"/></integrator>)";
    EXPECT_EQ(behind(GetParam(), lamp, limit("path", 2, true)), 0) << "the path may not scatter at the lamp";
    EXPECT_NEAR(behind(GetParam(), lamp, limit("path", 3, true)), share, 1e-5);
    EXPECT_NEAR(behind(GetParam(), lamp, limit("path", -1, true)), share, 1e-5);
    EXPECT_NEAR(behind(GetParam(), lamp, direct), share, 1e-5);
    EXPECT_EQ(behind(GetParam(), lamp, limit("volpath", -1, true)), 0);
    EXPECT_EQ(behind(GetParam(), sky, limit("path", -1, true)), 0);
    EXPECT_NEAR(behind(GetParam(), sky, direct), share, 1e-5);
    EXPECT_EQ(behind(GetParam(), sky, limit("volpath", -1, true)), 0);
}
INSTANTIATE_TEST_SUITE_P(Sheets, Passages, testing::ValuesIn(sheets),
                         [](const auto& sheet) { return std::string(sheet.param.name); });

// --- a thin pane: passed by 1 - F', whose incidence at the lamp's place aside is 56 degrees ---

constexpr double aside = 3, paneIndex = 1.5;

/// Radiance of the floor.
double seenThrough(double transmittance) {
    const double distance = std::hypot(aside, height), cosine = height / distance;
    return transmittance * intensity * cosine / (distance * distance) * floorReflectance / std::numbers::pi;
}
const double slanted = test::paneTransmittance(height / std::hypot(aside, height), paneIndex);

MeanAndError renderPane(DirectLight direct, int maxDepth = -1, MapOrder map = MapOrder::photons,
                        const char* integrator = "path", unsigned photons = 640'000) {
    return renderScene(sheetScene(R"(<bsdf type="thindielectric"><float name="int_ior" value="1.5"/>
        <float name="ext_ior" value="1"/><rgb name="specular_reflectance" value="0"/></bsdf>)",
                                  maxDepth, aside, integrator),
                       direct, map, direct == DirectLight::photons ? photons : 10'000);
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
    for (const auto direct : {DirectLight::emitters, DirectLight::photons})
        EXPECT_EQ(renderPane(direct, 2, MapOrder::photons, "path", 20'000).mean, 0);
}

TEST(LightThroughAPane, BeginsNoSegmentInIntegratorsOfVolumes) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto result = renderPane(direct, 2, MapOrder::photons, "volpath");
        EXPECT_NEAR(result.mean, seenThrough(slanted), 3 * result.standardError + 0.005 * seenThrough(slanted));
    }
}

// ---- shadow rays that a sheet moves ------------------------------------------------------------------------------

/// A square lamp of side 0.5 two units above a floor, and a tilted half-open sheet between them, all at (place, place).
Scene tiltedSheet(double place) {
    const std::string at = fmt::format("{0},{0},", place), shift = fmt::format("x=\"{0}\" y=\"{0}\"", place);
    return placedScene(orthographicSensor(at + "0.15", at + "0", 0.02, 4) + fmt::format(R"(
<shape type="rectangle"><transform name="to_world"><scale value="3"/><translate {0}/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="{1}"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="45"/><translate {0} z="1"/></transform>
    <bsdf type="mask"><float name="opacity" value="0.5"/>{2}</bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.25"/><rotate x="1" angle="180"/><translate {0} z="2"/></transform>
    {2}<emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>)",
                                                                                        shift, floorReflectance, black),
                       Placement{});
}

// A surface that a shadow ray passes moves it by the bound on its place, which of a tilted one is large; the rest of the
// ray must be the shorter for it, or it meets the lamp that it comes from. Control: the rest is as long as before.
TEST(TiltedSheet, DoesNotLetShadowRaysMeetTheirLamp) {
    const double a = 0.125, s = std::sqrt(1 + a * a); // half of the lamp's side over its distance
    const double formFactor = 4 / std::numbers::pi * a / s * std::atan(a / s);
    const double radiance = floorReflectance * 0.5 * 10 * formFactor;
    for (const double place : {0.0, 10.0}) {
        RenderSettings settings;
        settings.photonsPerPass = 1000;
        settings.furtherFeatures = test::surfaceFeatures();
        const auto render = [&] {
            return renderGroups(tiltedSheet(place), settings, std::vector<int>(16, 0), 10, 20).front();
        };
        const auto right = render();
        EXPECT_NEAR(right.mean, radiance, 3 * right.standardError + 0.005 * radiance) << place;
        settings.controlOptions = optionOf(test::SurfaceRule::movedShadows);
        EXPECT_LT(render().mean, 0.7 * radiance) << "negative control";
    }
}

} // namespace
} // namespace quasilux
