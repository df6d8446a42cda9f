// Scenes far from the origin of their file keep their shape: they are loaded relative to their centre.
#include "support/scene_files.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

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

// Where it stands is known from the shapes, whatever else there is.
TEST(Origin, LoadsASmallLampFarAwayWithoutASensor) {
    const SceneFiles files;
    const Scene scene = loadScene(files.write("scene.xml", R"(<scene version="3.0.0">
<?quasilux illuminance-grid origin="100000,100000,0" edge-u="1,0,0" edge-v="0,1,0" nx="2" ny="2"?>
<shape type="rectangle"><transform name="to_world"><scale value="1e-3"/><translate value="100000,100000,2"/></transform>
<emitter type="area"/></shape></scene>)"));
    const auto& p = scene.shapes[0].mesh.positions;
    EXPECT_NEAR(glm::length(glm::dvec3(p[1]) - glm::dvec3(p[0])), 2e-3, 1e-9);
}

/// How often a file is opened while it lives.
class Openings {
public:
    explicit Openings(const std::string& path) : queue_(inotify_init1(IN_NONBLOCK)) {
        inotify_add_watch(queue_, path.c_str(), IN_OPEN | IN_CLOSE); // equal events in a row would become one
    }
    ~Openings() { close(queue_); }
    Openings(const Openings&) = delete;
    Openings& operator=(const Openings&) = delete;

    /// Since the last call.
    size_t count() const {
        inotify_event events[64];
        const ssize_t bytes = read(queue_, events, sizeof events);
        const inotify_event *first = events,
                            *end = events + (bytes > 0 ? static_cast<size_t>(bytes) / sizeof *events : 0);
        return static_cast<size_t>(std::count_if(first, end, [](const auto& e) { return (e.mask & IN_OPEN) != 0; }));
    }

private:
    int queue_;
};

TEST(Origin, MeshFilesAreReadOnceOrWhereTheSceneIsFarTwice) {
    const SceneFiles files;
    const std::string path = files.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), far = "100000,100000,0";
    const auto meshAt = [](const std::string& place) {
        return fmt::format(R"(<shape type="obj"><string name="filename" value="mesh.obj"/><transform name="to_world">
<translate value="{}"/></transform></shape>)",
                           place);
    };
    const auto lampOf = [&](const std::string& scale) {
        return fmt::format(
            R"(<shape type="rectangle"><transform name="to_world"><scale value="{}"/><translate value="{}"/>
</transform><emitter type="area"/></shape>)",
            scale, far);
    };
    const Openings openings(path);
    loadScene(files.write("scene.xml", sceneAt("1,0,0", 1, meshAt("0,0,0"))));
    EXPECT_EQ(openings.count(), 1u);
    loadScene(files.write("scene.xml", sceneAt(far, 1, meshAt(far))));
    EXPECT_EQ(openings.count(), 2u);
    loadScene(files.write("scene.xml", sceneAt(far, 1, meshAt(far) + lampOf("1e-3"))));
    EXPECT_EQ(openings.count(), 2u) << "a lamp that has no area at first";
    errorOf(files.write("scene.xml", sceneAt("1,0,0", 1, meshAt("0,0,0") + "<shape type=\"cone\"/>")));
    EXPECT_EQ(openings.count(), 1u) << "a scene with an error";
}

TEST(Origin, ErrorsStayTheSame) {
    const SceneFiles files;
    const std::string flat =
        R"(<shape type="rectangle"><transform name="to_world"><scale x="1e-30" y="1e-30"/></transform><emitter type="area"/></shape>)";
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneAt("1e5,0,0", 1, flat))), testing::HasSubstr("has no area"));
}

} // namespace
} // namespace quasilux
