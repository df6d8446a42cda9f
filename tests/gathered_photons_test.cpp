// Which photons of a pass are gathered, where it is known: two plates that face each other, and a camera that sees one
// of them whole.
//
// Nothing is left to chance but which few photons lie between the discs of 32 x 32 pixels; seeds are fixed.
#include "render/renderer.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>

namespace quasilux {
namespace {

Scene twoPlates(const char* target, const std::string& filter = "box") {
    test::SceneFiles files;
    return loadScene(files.write(
        "scene.xml",
        std::string(
            R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <lookat origin="0,0,1" target=")") +
            target + R"(" up="0,1,0"/></transform>
        <film type="hdrfilm"><rfilter type=")" +
            filter + R"("/><integer name="width" value="32"/><integer name="height" value="32"/></film></sensor>
        <shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf></shape>
        <emitter type="point"><point name="position" value="0,0,0.7"/><rgb name="intensity" value="1"/></emitter></scene>)"));
}

GatheredCount gathered(const char* target, const std::string& filter = "box") {
    RenderSettings settings;
    settings.photonsPerPass = 20'000;
    Renderer renderer(testDevice(), twoPlates(target, filter), settings);
    renderer.renderPass(0);
    return renderer.countGathered().value();
}

TEST(GatheredPhotons, AreThoseOfThePlateThatIsSeen) {
    const GatheredCount floor = gathered("0,0,0"), ceiling = gathered("0,0,2");
    EXPECT_EQ(floor.stored, ceiling.stored); // the same photons
    EXPECT_GT(floor.stored[LIGHT_DIFFUSE], 1000u);
    // Each sees its own, and both together all.
    EXPECT_NEAR(floor.share() + ceiling.share(), 1, 0.01);
    EXPECT_GT(floor.share(), 0.2);
    EXPECT_GT(ceiling.share(), 0.2);
}

// With a filter wider than a pixel, samples lie beyond the image's edge too.
TEST(GatheredPhotons, AreThoseOfSharedSamples) {
    const double box = gathered("0,0,0").share(), wide = gathered("0,0,0", "lanczos").share();
    EXPECT_NEAR(wide, box, 0.02);
}

TEST(GatheredPhotons, AreNotCountedWithoutAPhotonMapForACamera) {
    RenderSettings settings;
    settings.photonsPerPass = 1000;
    settings.map = MapOrder::camera;
    Renderer renderer(testDevice(), twoPlates("0,0,0"), settings);
    EXPECT_FALSE(renderer.countGathered().has_value());
}

} // namespace
} // namespace quasilux
