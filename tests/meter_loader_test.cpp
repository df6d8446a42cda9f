// Meters and grids in scene files: what is read, and what is refused with which words.
#include "support/meter_scenes.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

std::string errorOf(const std::string& body) {
    test::SceneFiles files;
    return test::errorOf(files.write("scene.xml", "<scene version=\"3.0.0\">\n" + body + "\n</scene>\n"));
}

const std::string light = test::minimalLight;
const std::string plate = "<shape type=\"rectangle\">" + test::irradiancemeter(3, 2) + "</shape>\n";

TEST(MeterLoader, ReadsAnIrradiancemeterOnItsShape) {
    const Scene scene = test::meterScene(light + "<shape type=\"sphere\"/>" + plate);
    EXPECT_EQ(scene.sensor.meter, MeterKind::area);
    EXPECT_EQ(scene.sensor.meterShape, 1u);
    EXPECT_EQ(scene.sensor.width, 3u);
    EXPECT_EQ(scene.sensor.height, 2u);
}

TEST(MeterLoader, RendersTheFirstSensorOfTheFile) {
    const Scene camera = test::meterScene(light + test::minimalSensor + plate);
    EXPECT_EQ(camera.sensor.meter, MeterKind::none);
    ASSERT_EQ(camera.warnings.size(), 1u);
    EXPECT_THAT(camera.warnings[0], HasSubstr("only the first one is rendered"));
    EXPECT_EQ(test::meterScene(light + plate + test::minimalSensor).sensor.meter, MeterKind::area);
}

TEST(MeterLoader, ReadsARadiancemeterEitherWay) {
    const std::string begin = "<sensor type=\"radiancemeter\">" + test::film(1, 1);
    const Scene byRay = test::meterScene(light + begin +
                                         "<point name=\"origin\" x=\"1\" y=\"2\" z=\"3\"/>"
                                         "<vector name=\"direction\" x=\"0\" y=\"0\" z=\"-4\"/></sensor>");
    const Scene byTransform = test::meterScene(light + begin +
                                               "<transform name=\"to_world\"><rotate y=\"1\" angle=\"180\"/>"
                                               "<translate x=\"1\" y=\"2\" z=\"3\"/></transform></sensor>");
    for (const Scene* scene : {&byRay, &byTransform}) {
        EXPECT_EQ(scene->sensor.meter, MeterKind::ray);
        test::expectNear(glm::vec3(scene->sensor.toWorld[3]), {1, 2, 3});
        test::expectNear(glm::vec3(scene->sensor.toWorld[2]), {0, 0, -1});
    }
}

TEST(MeterLoader, ReadsAGrid) {
    const Scene scene = test::meterScene(light + "<?quasilux illuminance-grid origin=\"1,2,3\" edge-u=\"4,0,0\" "
                                                 "edge-v=\"0,2,0\" nx=\"2\" ny=\"1\" normal=\"0,0,-1\"?>");
    ASSERT_EQ(scene.grids.size(), 1u);
    test::expectNear(glm::vec3(scene.grids.front().point(1, 0)), {4, 3, 3});
    test::expectNear(glm::vec3(scene.grids.front().normal()), {0, 0, -1});
}

TEST(MeterErrors, SayWhatIsWrong) {
    const std::string one = test::film(1, 1);
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"<sensor type=\"irradiancemeter\"/>", ":3:1: sensor 'irradiancemeter' measures on a shape"},
        {"<shape type=\"sphere\"><sensor type=\"perspective\"/></shape>", "may not stand in a <shape>"},
        {"<shape type=\"sphere\"><sensor type=\"irradiancemeter\"><transform name=\"to_world\"/></sensor></shape>",
         "move the shape instead"},
        {"<shape type=\"sphere\"><sensor type=\"irradiancemeter\"><float name=\"fov\" value=\"3\"/></sensor></shape>",
         "fov"},
        {"<sensor type=\"radiancemeter\"/>", "expected 1 x 1"},
        {"<sensor type=\"radiancemeter\">" + one + "<point name=\"origin\" value=\"0,0,0\"/></sensor>",
         "give origin and direction"},
        {"<sensor type=\"radiancemeter\">" + one +
             "<point name=\"origin\" value=\"0,0,0\"/><vector name=\"direction\" value=\"0,0,0\"/></sensor>",
         "must have a length"},
        {"<sensor type=\"radiancemeter\">" + one +
             "<point name=\"origin\" value=\"0,0,0\"/><vector name=\"direction\" value=\"0,0,1\"/>"
             "<transform name=\"to_world\"/></sensor>",
         "keep one"},
        {"<?quasilux illuminance-gird nx=\"1\"?>", "illuminance-grid"},
        {"<?quasilux illuminance-grid nx=\"1\"?>", ":3:1: the illuminance-grid lacks origin"},
        {"<?quasilux illuminance-grid origin=\"0,0\" edge-u=\"1,0,0\" edge-v=\"0,1,0\" nx=\"1\" ny=\"1\"?>",
         "expected three"},
        {"<?quasilux illuminance-grid origin=\"0,0,0\" edge-u=\"1,0,0\" edge-v=\"2,0,0\" nx=\"1\" ny=\"1\"?>",
         "span no area"},
        {"<?quasilux illuminance-grid origin=\"0,0,0\" edge-u=\"1,0,0\" edge-v=\"0,1,0\" nx=\"0\" ny=\"1\"?>", "nx"},
        {"<?quasilux illuminance-grid origin=\"0,0,0\" edge-u=\"1,0,0\" edge-v=\"0,1,0\" nx=\"1\" ny=\"1\" "
         "normal=\"1,0,0\"?>",
         "not perpendicular"},
        {"<?quasilux illuminance-grid origin=\"0,0,0\" edge-u=\"1,0,0\" edge-v=\"0,1,0\" nx=\"1\" ny=\"1\" nz=\"1\"?>",
         "unknown key 'nz'"},
        {"<?quasilux units=\"lux\"?>", "units: unknown value 'lux'"},
    };
    for (const auto& [body, message] : cases) EXPECT_THAT(errorOf(light + body), HasSubstr(message)) << body;
}

TEST(MeterErrors, AGridThatIsMissingIsSaid) {
    Scene scene = test::meterScene(light + plate);
    EXPECT_THROW(useGridsAsSensor(scene), InputError);
}

} // namespace
} // namespace quasilux
