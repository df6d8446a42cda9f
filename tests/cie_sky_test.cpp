// <emitter type="quasilux_cie_sky">: luminances of CIE S 011 against closed forms and hand computation, lux on grids,
// and reading. Renders are held to 4 standard errors (0.3 %, Student t) with a known noise. Seeds are fixed.
#include "output/meter_reading.h"
#include "scene/emitters/cie_sky.h"
#include "support/meter_readings.h"
#include "support/sky_directions.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;

TEST(CieSky, LuminancesAreThoseOfTheStandard) {
    const dvec3 sun = towards(45, 0);
    for (const double zenith : {0.0, 40.0, 80.0, 90.0}) {
        EXPECT_NEAR(cieSkyLuminance(5, towards(zenith, 70), sun), 1, 1e-12) << "uniform";
        EXPECT_NEAR(cieSkyLuminance(16, towards(zenith, 70), sun), (1 + 2 * std::cos(zenith * degree)) / 3, 1e-12);
    }
    for (int type = 1; type <= cieSkyTypes; ++type) {
        EXPECT_NEAR(cieSkyLuminance(type, {0, 0, 1}, sun), 1, 1e-12) << type;
        EXPECT_EQ(cieSkyLuminance(type, {0, 1, -1e-9}, sun), 0) << type;
    }
    // By hand from the standard's formulae: the horizon under an overcast sky, 1 / (1 + 4 exp(-0.7)); a clear sky (type
    // 12) beside the sun at 45 degrees and on the other side, by f = 1 + 10 (exp(-3 x) - exp(-1.5 pi)) + 0.45 cos^2 x
    // and 1 - exp(-0.32 / cos Z).
    EXPECT_NEAR(cieSkyLuminance(1, towards(90, 10), sun), 0.334858, 1e-6);
    EXPECT_NEAR(cieSkyLuminance(12, sun, sun), 7.249075, 1e-6);
    EXPECT_NEAR(cieSkyLuminance(12, towards(45, 180), sun), 0.638113, 1e-6);
    EXPECT_NEAR(cieSkyLuminance(12, towards(90, 90), sun), 1.753085, 1e-6);
}

TEST(CieSky, IlluminancesAreTheirIntegrals) {
    EXPECT_NEAR(cieSkyIlluminance(5, {0, 0, 1}), pi, 1e-4);
    EXPECT_NEAR(cieSkyIlluminance(16, {0, 0, 1}), 7 * pi / 9, 1e-4) << "Moon & Spencer 1942";
    // Gradations alone: 2 pi times the integral of (1 + a exp(b / mu)) mu / (1 + a exp(b)).
    double sum = 0;
    for (int k = 0; k < 100000; ++k) {
        const double mu = (k + 0.5) / 100000;
        sum += (1 + 4 * std::exp(-0.7 / mu)) * mu / 100000;
    }
    EXPECT_NEAR(cieSkyIlluminance(1, {0, 0, 1}), 2 * pi * sum / (1 + 4 * std::exp(-0.7)), 1e-4);
    // Turning the sun about the vertical changes nothing.
    EXPECT_NEAR(cieSkyIlluminance(13, towards(50, 0)) / cieSkyIlluminance(13, towards(50, 77)), 1, 1e-4);
}

// --- renders ---

struct Lux {
    double value, standardError;
};
/// Lux of a point at the origin, its face spanned by two edges.
Lux luxOn(const std::string& sky, const std::string& edges) {
    Scene scene =
        test::meterScene(sky + "<?quasilux illuminance-grid origin=\"0,0,0\" " + edges + " nx=\"1\" ny=\"1\"?>");
    useGridsAsSensor(scene);
    RenderSettings settings;
    settings.photonsPerPass = 1000;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 64; ++pass) renderer.renderPass(pass);
    const MeterReading reading = readingOf(renderer.develop(), 0, false);
    return {reading.photometricValue, reading.photometricStandardError};
}
const std::string upwards = "edge-u=\"1,0,0\" edge-v=\"0,1,0\"", southwards = "edge-u=\"1,0,0\" edge-v=\"0,0,1\"";

std::string skyXml(const std::string& parameters) {
    return "<emitter type=\"quasilux_cie_sky\">\n" + parameters + "</emitter>";
}
std::string sky(int type, const std::string& more = "") {
    return skyXml(fmt::format(R"(<integer name="sky_type" value="{}"/><float name="illuminance" value="12000"/>
        <vector name="sun_direction" value="0.3,-0.7,0.6"/>)",
                              type) +
                  more);
}

void expectLux(const Lux& lux, double truth, const std::string& what) {
    const double allowed = 4 * lux.standardError + 5e-4 * truth;
    EXPECT_NEAR(lux.value, truth, allowed) << what;
    EXPECT_LT(allowed, 0.003 * truth) << what << ": too noisy to decide anything";
}

TEST(CieSkyRender, GroundHasTheIlluminanceThatIsStated) {
    for (const int type : {1, 5, 9, 12, 15, 16})
        expectLux(luxOn(sky(type), upwards), 12000, "type " + std::to_string(type));
    const double sine = 0.6 / std::sqrt(0.3 * 0.3 + 0.7 * 0.7 + 0.6 * 0.6);
    expectLux(luxOn(sky(12, "<float name=\"sun_illuminance\" value=\"60000\"/>"), upwards), 12000 + 60000 * sine,
              "sun");
    expectLux(
        luxOn(skyXml("<integer name=\"sky_type\" value=\"16\"/><float name=\"zenith_luminance\" value=\"5000\"/>"),
              upwards),
        5000 * 7 * pi / 9, "by its zenith");
    expectLux(luxOn(sky(12, "<float name=\"colour_temperature\" value=\"9000\"/>"), upwards), 12000,
              "a colour changes no lux");
}

TEST(CieSkyRender, WallsSeeHalfOfItAndTheGround) {
    // Of the traditional overcast sky a free wall has 39.6 % of the ground's by integration: (pi / 2 + 4 / 3) / (7 pi /
    // 3).
    const double share = (pi / 2 + 4.0 / 3) / (7 * pi / 3);
    EXPECT_NEAR(share, 0.396, 5e-4) << "BRE's vertical sky component";
    expectLux(luxOn(sky(16), southwards), share * 12000, "overcast");
    expectLux(luxOn(sky(5), southwards), 6000, "uniform");
    expectLux(luxOn(sky(5, "<float name=\"ground_albedo\" value=\"0.2\"/>"), southwards), 6000 * 1.2, "ground");
    // The sun is in the south, -y; turned about the vertical by 180 degrees it is in the north.
    const Lux south = luxOn(sky(12), southwards);
    const Lux north =
        luxOn(sky(12, "<transform name=\"to_world\"><rotate z=\"1\" angle=\"180\"/></transform>"), southwards);
    EXPECT_GT(south.value, 2 * north.value);
}

TEST(CieSkyRender, PerezSkyAndSunHaveTheirIlluminances) {
    expectLux(
        luxOn("<emitter type=\"quasilux_perez_sky\"><vector name=\"sun_direction\" value=\"0.3,-0.7,0.6\"/><float "
              "name=\"direct_normal_irradiance\" value=\"600\"/><float name=\"diffuse_horizontal_irradiance\" "
              "value=\"120\"/><float name=\"diffuse_horizontal_illuminance\" value=\"15000\"/><float "
              "name=\"direct_normal_illuminance\" value=\"60000\"/></emitter>",
              upwards),
        15000 + 60000 * 0.6 / std::sqrt(0.94), "Perez");
}

// The sun by place and time stands where sun_direction would put it: in the south-west on a map whose +y is the north.
TEST(CieSkyReader, SunStandsByPlaceAndTime) {
    test::SceneFiles files;
    const std::string sun = "<float name=\"sun_illuminance\" value=\"1000\"/>",
                      place = R"(<float name="latitude" value="39.742476"/><float name="longitude" value="-105.1786"/>
        <float name="timezone" value="-7"/><integer name="year" value="2003"/><integer name="month" value="10"/>
        <integer name="day" value="17"/><float name="hour" value="12"/><float name="minute" value="30"/>
        <float name="second" value="30"/>)";
    const Scene scene = loadScene(files.write("scene.xml", test::sceneWith(skyXml(sun + place))));
    const dvec3 from(-scene.directionalEmitters.at(0).direction);
    EXPECT_NEAR(std::atan2(from.x, from.y) / degree + 360, 194.34024, 0.01);
    EXPECT_NEAR(std::acos(from.z) / degree, 50.11, 0.01) << "with the refraction of sea level";
}

TEST(CieSkyReader, SomeSkiesNeedNoSun) {
    for (const int type : {1, 3, 5, 16})
        EXPECT_TRUE(test::meterScene(skyXml(fmt::format("<integer name=\"sky_type\" value=\"{}\"/>", type)) +
                                     "<?quasilux illuminance-grid origin=\"0,0,0\" " + upwards + " nx=\"1\" ny=\"1\"?>")
                        .surroundings)
            << type;
}

TEST(CieSkyReader, SaysWhatIsWrong) {
    test::SceneFiles files;
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"<integer name=\"sky_type\" value=\"17\"/>", {"scene.xml:5:1", "expected 1 to 15"}},
        {"<vector name=\"sun_direction\" value=\"0,1,-1\"/>", {"scene.xml:5:1", "below the horizon"}},
        {"<float name=\"illuminance\" value=\"0\"/>", {"scene.xml:5:1", "illuminance"}},
        {"<integer name=\"sky_type\" value=\"12\"/>", {"scene.xml:5:1", "needs the sun, as its sky_type is 12"}},
        {"<integer name=\"sky_type\" value=\"2\"/>", {"scene.xml:5:1", "needs the sun, as its sky_type is 2"}},
        {"<integer name=\"year\" value=\"2020\"/>", {"scene.xml:5:1", "has year but no latitude"}},
        {"<float name=\"illuminance\" value=\"1\"/><float name=\"zenith_luminance\" value=\"1\"/>", {"keep one"}},
        {"<float name=\"ground_albedo\" value=\"1.5\"/>", {"scene.xml:5:1", "ground_albedo"}},
        {"<transform name=\"to_world\"><scale x=\"2\"/></transform>", {"scene.xml:5:1", "not shear it"}},
        {"<float name=\"illuminanc\" value=\"1\"/>", {"Did you mean 'illuminance'"}}};
    test::expectErrors(files, cases, skyXml);
}

} // namespace
} // namespace quasilux
