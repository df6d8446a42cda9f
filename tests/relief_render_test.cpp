// Normal and bump maps against closed forms: one point light, a diffuse sheet whose normal is bent alike everywhere,
// seen by samples of the light and by photons.
// A right case passes within 3 standard errors of 10 batches (Student t, 1.5 % a case; seeds are fixed) plus 0.5 % for
// the density radius.
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "util/temporary_folder.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;

constexpr double reflectance = 0.8, intensity = 10;

struct Case {
    const char* name;
    const char* bsdf;   ///< {} stands for the file of the map
    const char* pixels; ///< PPM, 8 bits
    dvec3 viewer;       ///< direction to it
    dvec3 light;        ///< its place
    dvec3 normal;       ///< that the viewer ought to see, of any length
    double plainZ = 0;  ///< cosine between both normals where the light is shadowed by that; 0: not at all
};

#define DIFFUSE R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf>)"
#define MAP(name)                                                                                                      \
    "<texture type=\"bitmap\" name=\"" name "\"><string name=\"filename\" value=\"{}\"/>"                              \
    "<boolean name=\"raw\" value=\"true\"/></texture>"
#define UNSHADOWED "<boolean name=\"use_shadowing_function\" value=\"false\"/>"

const char* const plainMap = "<bsdf type=\"normalmap\">" MAP("normalmap") UNSHADOWED DIFFUSE "</bsdf>";
const char* const usualMap = "<bsdf type=\"normalmap\">" MAP("normalmap") DIFFUSE "</bsdf>";
const char* const twoSidedOutside =
    "<bsdf type=\"twosided\"><bsdf type=\"normalmap\">" MAP("normalmap") UNSHADOWED DIFFUSE "</bsdf></bsdf>";
const char* const twoSidedInside =
    "<bsdf type=\"normalmap\">" MAP("normalmap") UNSHADOWED "<bsdf type=\"twosided\">" DIFFUSE "</bsdf></bsdf>";
const char* const bumps =
    "<bsdf type=\"bumpmap\">" MAP("any") UNSHADOWED "<float name=\"scale\" value=\"0.5\"/>" DIFFUSE "</bsdf>";

const char* const leaning = "P3\n1 1\n255\n191 128 238\n"; // about 30 degrees to +x
const char* const steep = "P3\n1 1\n255\n242 128 183\n";   // about 64 degrees
const char* const ramp = "P3\n2 1\n255\n64 64 64 191 191 191\n";

dvec3 decoded(int r, int g, int b) { return glm::normalize(dvec3(r, g, b) / 127.5 - 1.0); }

const dvec3 lean = decoded(191, 128, 238), cliff = decoded(242, 128, 183);
/// Rises by (191 - 64) / 255 * 0.5 on half the sheet's width of 2.
const dvec3 ofRamp = {-(191 - 64) / 255.0 * 0.5 * 2 / 2, 0, 1};

Scene sheetScene(const Case& c) {
    const test::SceneFiles files;
    const std::string bsdf = fmt::format(fmt::runtime(c.bsdf), files.write("map.ppm", c.pixels));
    const auto text = [](dvec3 v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    return placedScene(orthographicSensor(text(c.viewer), "0,0,0", 0.05, 4) + fmt::format(R"(
<shape type="rectangle"><transform name="to_world"></transform>{}</shape>
<emitter type="point"><rgb name="intensity" value="{}"/><transform name="to_world"><translate value="{}"/></transform></emitter>)",
                                                                                          bsdf, intensity,
                                                                                          text(c.light)),
                       Placement{});
}

MeanAndError render(const Case& c, DirectLight direct) {
    RenderSettings settings;
    settings.direct = direct;
    settings.photonsPerPass = 40'000;
    settings.radiusScale = 0.5;
    return renderGroups(sheetScene(c), settings, std::vector<int>(16, 0), 10, 12).front();
}

double expected(const Case& c) {
    const dvec3 light = glm::normalize(c.light);
    double shadow = 1;
    if (c.plainZ > 0) { // Conty Estevez et al. 2019
        const double alpha2 = std::min(0.125 * (1 / (c.plainZ * c.plainZ) - 1), 1.0);
        shadow = 2 / (1 + std::sqrt(1 + alpha2 * (1 / (light.z * light.z) - 1)));
    }
    return reflectance / std::numbers::pi * intensity / glm::dot(c.light, c.light) * shadow *
           std::max(glm::dot(light, glm::normalize(c.normal)), 0.0);
}

class ReliefCase : public testing::TestWithParam<Case> {};
TEST_P(ReliefCase, HasTheClosedForm) {
    const double truth = expected(GetParam());
    ASSERT_GT(truth, 0.05);
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto result = render(GetParam(), direct);
        EXPECT_NEAR(result.mean, truth, 3 * result.standardError + 0.005 * truth) << name(direct);
        EXPECT_LT(result.standardError, 0.03 * truth) << "too noisy to tell anything";
        // Control: as a flat sheet it would look otherwise.
        Case flat = GetParam();
        flat.normal = {0, 0, flat.viewer.z};
        flat.plainZ = 0;
        EXPECT_GT(std::abs(result.mean - expected(flat)), 3 * result.standardError + 0.005 * truth) << "seems flat";
    }
}
const dvec3 above = {0, 0, 1}, below = {0, 0, -1};
INSTANTIATE_TEST_SUITE_P(
    Relief, ReliefCase,
    testing::Values(Case{"TowardsTheLight", plainMap, leaning, above, {1, 0, 2}, lean},
                    Case{"AwayFromTheLight", plainMap, leaning, above, {-1, 0, 2}, lean},
                    Case{"Shadowed", usualMap, leaning, above, {2.5, 0, 1}, lean, lean.z},
                    Case{"TurnedOver", plainMap, steep, {-0.8, 0, 0.6}, {-1, 0, 2}, {-cliff.x, -cliff.y, cliff.z}},
                    Case{"TurnedOverAndShadowed",
                         usualMap,
                         steep,
                         {-0.8, 0, 0.6},
                         {-1, 0, 2},
                         {-cliff.x, -cliff.y, cliff.z},
                         cliff.z},
                    Case{"MirroredBehind", twoSidedOutside, leaning, below, {1, 0, -2}, {lean.x, lean.y, -lean.z}},
                    Case{"OppositeBehind", twoSidedInside, leaning, below, {1, 0, -2}, -lean},
                    Case{"Bump", bumps, ramp, above, {1, 0, 2}, ofRamp}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(Relief, AnInvalidNormalIsBlackWhereNothingTurnsIt) {
    const std::string bsdf =
        std::string("<bsdf type=\"normalmap\"><boolean name=\"flip_invalid_normals\" value=\"false\"/>") +
        MAP("normalmap") + DIFFUSE "</bsdf>";
    const Case c{"Black", bsdf.c_str(), steep, {-0.8, 0, 0.6}, {-1, 0, 2}, above};
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) EXPECT_EQ(render(c, direct).mean, 0);
}

// Seen at 60 degrees through a mask whose normals lean by 30: its shadowing, 0.97, is of what it scatters.
TEST(Relief, AMaskLetsLightPassAsIfItWereNotThere) {
    const TemporaryFolder folder;
    const std::string map = (folder.path() / "map.ppm").string();
    std::ofstream(map) << leaning;
    const std::string bsdf = R"(<bsdf type="mask"><float name="opacity" value="0.25"/><bsdf type="normalmap">)" +
                             fmt::format(fmt::runtime(MAP("normalmap")), map) +
                             R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.001"/></bsdf></bsdf></bsdf>)";
    const Scene scene = placedScene(orthographicSensor("0,0.866025,0.5", "0,0,0", 0.05, 4) +
                                        "<shape type=\"rectangle\"><transform name=\"to_world\"></transform>" + bsdf +
                                        "</shape><emitter type=\"constant\"/>",
                                    Placement{});
    RenderSettings settings;
    settings.photonsPerPass = 1000;
    const auto result = renderGroups(scene, settings, std::vector<int>(16, 0), 10, 40).front();
    EXPECT_NEAR(result.mean, 0.75, 3 * result.standardError + 0.002);
    EXPECT_LT(result.standardError, 0.005);
}

TEST(Relief, TheCameraMapRefusesIt) {
    const Case c{"Map", plainMap, leaning, above, {1, 0, 2}, lean};
    RenderSettings settings;
    settings.map = MapOrder::camera;
    EXPECT_THROW(renderGroups(sheetScene(c), settings, std::vector<int>(16, 0), 2, 1), InputError);
}

} // namespace
} // namespace quasilux
