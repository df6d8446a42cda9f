// Shading normals that disagree with the geometry: light traced forwards must be the adjoint of importance traced
// backwards (Veach 1997, sec. 5.3). A reflector is flat, its shading normal leans 40 degrees to a screen beside it.
//
// The screen's light comes by way of the reflector: with BDD 0 as photons that the reflector has scattered, with BDD 1 as
// camera paths that scatter at it. The reflector's own light: from samples of the emitter, or from direct photons.
// Two right renders agree within 3 standard errors (10 batches each: 0.7 % of pairs would fail for unlucky seeds, which
// are fixed) plus 0.5 % for the density radius.
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

/// Looks at the screen or at the reflector; the lamp shines on the reflector only.
Scene reflectorScene(bool atScreen) {
    const test::SceneFiles files;
    const auto mesh = files.write("reflector.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0.6427876 0 0.7660444\n"
                                                   "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
    const std::string sensor = atScreen ? orthographicSensor("0.9,0,1.3", "1.5,0,1", 0.3, 8)
                                        : orthographicSensor("0.3,0.1,1", "0,0,0", 0.3, 8);
    return placedScene(sensor + fmt::format(R"(
<shape type="obj"><string name="filename" value="{}"/><transform name="to_world"></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.9"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="-90"/><translate x="1.5" z="1"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="180"/><translate x="-0.5" z="3"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
<shape type="rectangle"><transform name="to_world"><scale value="0.9"/><rotate y="1" angle="90"/><translate x="0.7" z="2.3"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>)",
                                            mesh),
                       Placement{});
}

MeanAndError measure(bool atScreen, unsigned bdd, DirectLight direct, PhotonRule rule = PhotonRule::right,
                     MapOrder map = MapOrder::photons) {
    RenderSettings settings;
    settings.bdd = bdd;
    settings.direct = direct;
    settings.photonRule = rule;
    settings.map = map;
    settings.photonsPerPass = bdd == 0 ? 40'000 : 2000;
    settings.radiusScale = 0.5;
    return renderGroups(reflectorScene(atScreen), settings, std::vector<int>(64, 0), 10, bdd == 0 ? 8 : 300).front();
}

double deviation(const MeanAndError& a, const MeanAndError& b) {
    return (std::abs(a.mean - b.mean) - 0.005 * b.mean) / std::hypot(a.standardError, b.standardError);
}

TEST(ShadingNormals, PhotonsScatterAsCameraPathsDo) {
    const auto forwards = measure(true, 0, DirectLight::emitters), backwards = measure(true, 1, DirectLight::emitters);
    EXPECT_LE(deviation(forwards, backwards), 3) << forwards.mean << ' ' << backwards.mean;
    EXPECT_LT(std::hypot(forwards.standardError, backwards.standardError), 0.02 * backwards.mean) << "too noisy";
    const auto wrong = measure(true, 0, DirectLight::emitters, PhotonRule::missingAdjoint);
    EXPECT_GT(deviation(wrong, backwards), 3) << "control: " << wrong.mean << " looks right";
}

TEST(ShadingNormals, PhotonsArriveAsEmittersAreSampled) {
    const auto sampled = measure(false, 0, DirectLight::emitters);
    for (const auto map : {MapOrder::photons, MapOrder::camera}) {
        const auto photons = measure(false, 0, DirectLight::photons, PhotonRule::right, map);
        EXPECT_LE(deviation(photons, sampled), 3) << photons.mean << ' ' << sampled.mean;
        EXPECT_LT(photons.standardError, 0.02 * sampled.mean) << "too noisy";
    }
    const auto wrong = measure(false, 0, DirectLight::photons, PhotonRule::missingArrival);
    EXPECT_GT(deviation(wrong, sampled), 3) << "control: " << wrong.mean << " looks right";
}

} // namespace
} // namespace quasilux
