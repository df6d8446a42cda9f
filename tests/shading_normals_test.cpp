// Shading normals that disagree with the geometry: light traced forwards must be the adjoint of importance traced
// backwards (Veach 1997, sec. 5.3). A reflector is flat, its shading normal leans 40 degrees to a screen beside it.
//
// The screen's light comes by way of the reflector: with BDD 0 as photons that the reflector has scattered, with BDD 1
// as camera paths that scatter at it. The reflector's own light: from samples of the emitter, or from direct photons.
// Two right renders agree within 3 standard errors (10 batches each: 0.7 % of pairs would fail for unlucky seeds, which
// are fixed) plus 0.5 % for the density radius.
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::PhotonRule;

/// What makes the normal lean: normals of the mesh, or a normal map; `away` from the screen, to which it is turned over
/// then.
enum class Lean { vertices, map, mapAway };

std::string reflector(const test::SceneFiles& files, Lean lean) {
    const std::string bsdf = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf>)";
    if (lean == Lean::vertices)
        return fmt::format(
            R"(<shape type="obj"><string name="filename" value="{}"/><transform name="to_world"></transform>{}</shape>)",
            files.write("reflector.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0.6427876 0 0.7660444\n"
                                         "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n"),
            bsdf);
    const char* const pixel = lean == Lean::map ? "209 128 225" : "46 128 225"; // 40 degrees
    const std::string texture = fmt::format(
        R"(<texture type="bitmap" name="normalmap"><string name="filename" value="{}"/><boolean name="raw" value="true"/></texture>)",
        files.write("normal.ppm", fmt::format("P3\n1 1\n255\n{}\n", pixel)));
    return R"(<shape type="rectangle"><transform name="to_world"></transform><bsdf type="normalmap">)" + texture +
           bsdf + "</bsdf></shape>";
}

/// Looks at the screen or at the reflector; the lamp shines on the reflector only.
Scene reflectorScene(bool atScreen, Lean lean) {
    const test::SceneFiles files;
    const std::string sensor = atScreen ? orthographicSensor("0.9,0,1.3", "1.5,0,1", 0.3, 8)
                                        : orthographicSensor("0.3,0.1,1", "0,0,0", 0.3, 8);
    return placedScene(sensor + reflector(files, lean) + R"(
<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="-90"/><translate x="1.5" z="1"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/><translate x="-0.5" z="3"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.9"/><rotate y="1" angle="90"/><translate x="0.7" z="2.3"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>)",
                       Placement{});
}

MeanAndError measure(Lean lean, bool atScreen, unsigned bdd, DirectLight direct, PhotonRule rule = PhotonRule::right,
                     MapOrder map = MapOrder::photons) {
    RenderSettings settings;
    settings.bdd = bdd;
    settings.direct = direct;
    settings.controlOptions += optionOf(rule);
    settings.map = map;
    settings.photonsPerPass = bdd == 0 ? 40'000 : 2000;
    if (lean == Lean::vertices) settings.furtherFeatures = test::surfaceFeatures();
    settings.radiusScale = 0.5;
    // Little light comes back from there: eight times as many passes of photons, or camera paths.
    const unsigned more = lean == Lean::mapAway && atScreen ? 8 : 1;
    settings.cameraPaths = bdd == 0 ? 1 : more;
    const unsigned passes = bdd == 0 ? 8 * more : 300;
    return renderGroups(reflectorScene(atScreen, lean), settings, std::vector<int>(64, 0), 10, passes).front();
}

double deviation(const MeanAndError& a, const MeanAndError& b) {
    return (std::abs(a.mean - b.mean) - 0.005 * b.mean) / std::hypot(a.standardError, b.standardError);
}

class ShadingNormals : public testing::TestWithParam<Lean> {};
TEST_P(ShadingNormals, PhotonsScatterAsCameraPathsDo) {
    const Lean lean = GetParam();
    const auto forwards = measure(lean, true, 0, DirectLight::emitters),
               backwards = measure(lean, true, 1, DirectLight::emitters);
    EXPECT_LE(deviation(forwards, backwards), 3) << forwards.mean << ' ' << backwards.mean;
    EXPECT_LT(std::hypot(forwards.standardError, backwards.standardError), 0.02 * backwards.mean) << "too noisy";
    const auto wrong = measure(lean, true, 0, DirectLight::emitters, PhotonRule::missingAdjoint);
    EXPECT_GT(deviation(wrong, backwards), 3) << "control: " << wrong.mean << " looks right";
}

TEST_P(ShadingNormals, PhotonsArriveAsEmittersAreSampled) {
    const Lean lean = GetParam();
    const auto sampled = measure(lean, false, 0, DirectLight::emitters);
    for (const auto map : {MapOrder::photons, MapOrder::camera}) {
        if (map == MapOrder::camera && lean != Lean::vertices) continue; // refused
        const auto photons = measure(lean, false, 0, DirectLight::photons, PhotonRule::right, map);
        EXPECT_LE(deviation(photons, sampled), 3) << photons.mean << ' ' << sampled.mean;
        EXPECT_LT(photons.standardError, 0.02 * sampled.mean) << "too noisy";
    }
    const auto wrong = measure(lean, false, 0, DirectLight::photons, PhotonRule::missingArrival);
    EXPECT_GT(deviation(wrong, sampled), 3) << "control: " << wrong.mean << " looks right";
}

INSTANTIATE_TEST_SUITE_P(
    Leaning, ShadingNormals, testing::Values(Lean::vertices, Lean::map, Lean::mapAway), [](const auto& row) {
        return std::string(row.param == Lean::vertices ? "Vertices" : row.param == Lean::map ? "Map" : "MapAway");
    });

} // namespace
} // namespace quasilux
