// Scenes far from the origin of their file keep their shape: they are loaded relative to their centre.
#include "support/scene_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::SceneFiles;

std::string sceneAt(const std::string& offset, double scale, const std::string& extra = "") {
    return fmt::format(R"(<scene version="3.0.0">
<sensor type="perspective"><transform name="to_world"><lookat origin="0,0,{1}" target="0,0,0" up="0,1,0"/><translate value="{0}"/></transform></sensor>
<emitter type="point"><transform name="to_world"><translate z="{1}"/><translate value="{0}"/></transform></emitter>
<shape type="cube"><transform name="to_world"><scale value="{1}"/><translate value="{0}"/></transform></shape>
<shape type="sphere"><transform name="to_world"><scale value="{1}"/><translate value="{0}"/></transform></shape>
{2}
</scene>)",
                       offset, scale, extra);
}

TEST(Origin, StaysWhereTheSceneIsNear) {
    const SceneFiles files;
    for (const char* offset : {"0,0,0", "3,-2,1", "7.9,0,0"})
        EXPECT_EQ(loadScene(files.write("scene.xml", sceneAt(offset, 1))).origin, glm::dvec3(0)) << offset;
}

TEST(Origin, MovesToASceneThatIsFar) {
    const SceneFiles files;
    // Far is what it is to the scene's size.
    for (const auto& [offset, scale, place] :
         {std::tuple{"100000.1,-100000.2,50000.3", 1.0, glm::dvec3(100000.1, -100000.2, 50000.3)},
          std::tuple{"10.01,0,-3", 1e-4, glm::dvec3(10.01, 0, -3)},
          std::tuple{"1e7,0,0", 1e5, glm::dvec3(1e7, 0, 0)}}) {
        const Scene scene = loadScene(files.write("scene.xml", sceneAt(offset, scale)));
        // The centre is found in single precision; what counts is that everything is relative to the same place.
        const glm::dvec3 rest = place - scene.origin;
        EXPECT_LT(glm::length(rest), 1e-6 * glm::length(place));
        EXPECT_LT(glm::length(glm::dvec3(scene.shapes[0].mesh.positions[0]) - (rest - scale)), 1e-6 * scale);
        EXPECT_LT(glm::length(glm::dvec3(scene.shapes[1].sphere->center) - rest), 1e-6 * scale);
        const glm::dvec3 above = rest + glm::dvec3(0, 0, scale);
        EXPECT_LT(glm::length(glm::dvec3(scene.pointEmitters[0].position) - above), 1e-6 * scale);
        EXPECT_LT(glm::length(glm::dvec3(scene.sensor.toWorld[3]) - above), 1e-9 * glm::length(place));
    }
}

TEST(Origin, KeepsTheDigitsOfMeshFiles) {
    const SceneFiles files;
    files.write("far.obj", "v 100000.001 0 0\nv 100000.002 0 0\nv 100000.001 0.001 0\nf 1 2 3\n");
    const Scene scene = loadScene(files.write(
        "scene.xml", test::sceneWith("<shape type=\"obj\"><string name=\"filename\" value=\"far.obj\"/></shape>")));
    const auto& p = scene.shapes[0].mesh.positions;
    EXPECT_NEAR(double(p[1].x) - p[0].x, 1e-3, 1e-9);
    EXPECT_NEAR(double(p[2].y) - p[0].y, 1e-3, 1e-9);
}

// In single precision this lamp would have no area where it stands.
TEST(Origin, LoadsASmallLampFarAway) {
    const SceneFiles files;
    const std::string lamp = R"(<shape type="rectangle"><transform name="to_world"><scale value="1e-3"/>
<translate value="100000.1,-100000.2,50000.3"/></transform><emitter type="area"/></shape>)";
    const Scene scene = loadScene(files.write("scene.xml", sceneAt("100000.1,-100000.2,50000.3", 1, lamp)));
    const auto& p = scene.shapes[2].mesh.positions;
    EXPECT_NEAR(glm::length(glm::dvec3(p[1]) - glm::dvec3(p[0])), 2e-3, 1e-9);
}

TEST(Origin, ErrorsStayTheSame) {
    const SceneFiles files;
    const std::string flat =
        R"(<shape type="rectangle"><transform name="to_world"><scale x="1e-30" y="1e-30"/></transform><emitter type="area"/></shape>)";
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneAt("1e5,0,0", 1, flat))), testing::HasSubstr("has no area"));
}

} // namespace
} // namespace quasilux
