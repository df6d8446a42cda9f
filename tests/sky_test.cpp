// Scenes whose only light is the sky, against closed forms: the white furnace, and convex objects under direct light.
//
// False alarms: within 3 standard errors (from 10 batches: two-sided Student t, 1.5 % a case) plus 0.5 % for the
// density radius; the seeds are fixed, so a case that passes goes on passing.
#include "prepare/bounding_sphere.h"
#include "prepare/device_scene.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"

#include <numbers>

namespace quasilux {
namespace {

constexpr unsigned resolution = 16, batches = 10, passesPerBatch = 8;

struct Method {
    const char* name;
    unsigned bdd;
    Variant variant;
    DirectLight direct;
};

MeanAndError render(const Scene& scene, const Method& method) {
    RenderSettings settings;
    settings.bdd = method.bdd;
    settings.variant = method.variant;
    settings.direct = method.direct;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = 16000;
    return renderGroups(scene, settings, std::vector<int>(resolution * resolution, 0), batches, passesPerBatch).front();
}

double allowed(const MeanAndError& result, double truth) { return 3 * result.standardError + 0.005 * truth; }

Scene furnace() { return projectScene("furnace_sky.xml", {{"resolution", std::to_string(resolution)}}); }

/// A cube of albedo 0.5 under a sky; the camera looks along -z at `origin` and covers 1.4 units.
Scene loadCube(const std::string& origin = "0,0,5", int maxDepth = -1, double radiance = 2) {
    test::SceneFiles files;
    const std::string size = std::to_string(resolution);
    return loadScene(
        files.write("scene.xml", R"(<scene version="3.0.0"><integrator type="path"><integer name="max_depth"
        value=")" + std::to_string(maxDepth) +
                                     R"("/></integrator><sensor type="orthographic"><transform name="to_world">
        <scale x="0.7" y="0.7"/><rotate y="1" angle="180"/><translate value=")" +
                                     origin + R"("/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value=")" +
                                     size + R"("/><integer name="height" value=")" + size + R"("/></film></sensor>
        <emitter type="constant"><rgb name="radiance" value=")" +
                                     std::to_string(radiance) + R"("/></emitter>
        <shape type="cube"><bsdf type="diffuse"/></shape></scene>)"));
}

class Sky : public testing::TestWithParam<Method> {};

TEST_P(Sky, WhiteFurnaceIsWhite) {
    const auto result = render(furnace(), GetParam());
    EXPECT_NEAR(result.mean, 1, allowed(result, 1)) << "standard error " << result.standardError;
    EXPECT_LT(result.standardError, 0.01) << "too noisy to decide anything";
}

TEST_P(Sky, ConvexObjectShowsItsAlbedoByDirectLight) {
    // The camera sees nothing but one face of a cube.
    const Scene scene = loadCube();
    const auto result = render(scene, GetParam());
    EXPECT_NEAR(result.mean, 0.5 * 2, allowed(result, 1)) << "standard error " << result.standardError;
    EXPECT_LT(result.standardError, 0.01);
}

constexpr auto emitters = DirectLight::emitters;
constexpr auto photons = DirectLight::photons;
INSTANTIATE_TEST_SUITE_P(Furnace, Sky,
                         testing::Values(Method{"MainBdd0", 0, Variant::main, emitters},
                                         Method{"MainBdd1", 1, Variant::main, emitters},
                                         Method{"AlternativeBdd0", 0, Variant::alternative, emitters},
                                         Method{"AlternativeBdd1", 1, Variant::alternative, emitters},
                                         Method{"MainBdd0Photons", 0, Variant::main, photons},
                                         Method{"MainBdd1Photons", 1, Variant::main, photons},
                                         Method{"AlternativeBdd0Photons", 0, Variant::alternative, photons},
                                         Method{"AlternativeBdd1Photons", 1, Variant::alternative, photons}),
                         [](const auto& row) { return std::string(row.param.name); });

// Nothing but photons lights the face, so light that is wrong by 5 % stands for photons whose power is.
TEST(SkyControl, PhotonPowerWrongByFivePerCentShows) {
    const auto result = render(loadCube("0,0,5", -1, 2.1), {"", 0, Variant::main, photons});
    EXPECT_GT(std::abs(result.mean - 1), allowed(result, 1)) << result.mean << " looks right";
}

TEST(SkyScene, IsSeenInFullAndEndsWithTheDepthLimit) {
    const auto result = render(loadCube("0,0,5", 1), {"", 0, Variant::main, emitters});
    EXPECT_EQ(result.mean, 0) << "a face, of which max_depth 1 leaves nothing";
    const auto sky = render(loadCube("0,0,-2", 1), {"", 0, Variant::main, emitters});
    EXPECT_NEAR(sky.mean, 2, 1e-6) << "the cube is behind the camera";
}

TEST(SkyScene, PowerIsThatWhichEntersTheSphereAboutTheScene) {
    const Scene scene = test::loadBody(
        R"(<emitter type="constant"><rgb name="radiance" value="1,2,3"/></emitter>
           <shape type="sphere"><point name="center" x="1" y="2" z="3"/><float name="radius" value="2"/></shape>)");
    const auto flat = flattenEmitters(scene, placeMedia(scene));
    ASSERT_EQ(flat.emitters.size(), 2u); // with the point of every test scene
    EXPECT_EQ(flat.emitters.back().type, EMITTER_CONSTANT);
    const double pi = std::numbers::pi;
    EXPECT_NEAR(flat.power.back() / (4 * pi * pi * 4 * 2), 1, 1e-5);
    EXPECT_NEAR(flat.emitters.back().selectionProbability, flat.power[1] / (flat.power[0] + flat.power[1]), 1e-6);
}

TEST(BoundingSphere, HoldsShapesOfAllKinds) {
    const Sphere sphere =
        boundingSphere(test::loadBody(R"(<shape type="sphere"><point name="center" x="3" y="0" z="0"/></shape>)" +
                                      test::placed("cube", R"(<translate x="-3"/>)")));
    test::expectNear(sphere.center, {0, 0, 0});
    EXPECT_NEAR(sphere.radius, std::sqrt(18.0), 1e-4);
    EXPECT_EQ(boundingSphere(test::loadBody("")).radius, 1);
}

} // namespace
} // namespace quasilux
