// Thin bodies of one smooth surface: photons of one face are not taken for those of the other.
#include "support/render_statistics.h"
#include "support/rounded_board.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

constexpr double irradianceAbove = 100, irradianceBelow = 1, reflectance = 0.5;

/// A rounded board in light that falls straight down, and a hundredth of it straight up; seen from below or above.
Scene litBoard(bool fromBelow) {
    const test::SceneFiles files;
    Scene scene = loadScene(
        files.write("board.xml", R"(<scene version="3.0.0"><sensor type="orthographic"><transform name="to_world">
        <scale value="0.9"/><lookat origin="0,0,)" +
                                     std::string(fromBelow ? "-1" : "1") +
                                     R"(" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/><rfilter type="box"/></film></sensor>
        <emitter type="directional"><vector name="direction" value="0,0,-1"/><rgb name="irradiance" value="100"/></emitter>
        <emitter type="directional"><vector name="direction" value="0,0,1"/><rgb name="irradiance" value="1"/></emitter>
        <shape type="cube"><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape></scene>)"));
    scene.shapes[0].mesh = test::roundedBoard(0.02, 12);
    return scene;
}

// 16 batches, seed fixed: a right render fails with a probability of 1 % a face (Student t). As one patch the face below
// took photons of both, and was fifty times as bright.
TEST(ThinBodies, FacesHoldTheirOwnPhotons) {
    for (const bool fromBelow : {false, true}) {
        RenderSettings settings;
        settings.photonsPerPass = 20000;
        settings.direct = DirectLight::photons;
        const std::vector<int> all(64, 0);
        const auto found = renderGroups(litBoard(fromBelow), settings, all, 16, 64).front();
        const double radiance = (fromBelow ? irradianceBelow : irradianceAbove) * reflectance / std::numbers::pi;
        EXPECT_NEAR(found.mean, radiance, 2.95 * found.standardError) << (fromBelow ? "below" : "above");
        EXPECT_LT(found.standardError, 0.05 * radiance) << "too noisy to decide anything";
    }
}

} // namespace
} // namespace quasilux
