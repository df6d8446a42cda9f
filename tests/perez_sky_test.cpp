// The all-weather sky of Perez et al. and weather files. Luminances of the model are held against the formulae of the
// papers written out in a script of its own, for five skies from overcast to clear; integrals of images by their own
// sum.
#include "scene/photometric_units.h"
#include "scene/skies/perez_sky.h"
#include "scene/skies/sky_image.h"
#include "scene/skies/sun_position.h"
#include "scene/skies/weather_file.h"
#include "support/scene_files.h"
#include "support/sky_directions.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using glm::dvec3;
using testing::HasSubstr;

struct Case {
    double directNormal, diffuseHorizontal, sunZenith;
    double clearness, brightness, below,
        opposite; // luminances at 80 degrees, and across the zenith, over that of the zenith
};
const Case cases[] = {
    {0, 100, 60, 1.00000, 0.14578, 0.76029, 0.78050},   {50, 250, 40, 1.14769, 0.23842, 1.89538, 0.58793},
    {300, 200, 50, 1.88662, 0.22715, 4.45406, 0.77815}, {500, 150, 65, 2.32279, 0.25829, 10.01045, 1.27020},
    {800, 90, 35, 8.18414, 0.08028, 2.68123, 0.56085},
};

PerezSky skyOf(const Case& c) { return {{c.directNormal, c.diffuseHorizontal, 11, 1}, towards(c.sunZenith)}; }

TEST(PerezSky, LuminancesAreThoseOfThePaper) {
    for (const Case& c : cases) {
        const PerezSky sky = skyOf(c);
        EXPECT_NEAR(sky.clearness(), c.clearness, 1e-4);
        EXPECT_NEAR(sky.brightness(), c.brightness, 1e-4);
        EXPECT_NEAR(sky.luminance(towards(80)) / sky.luminance(towards(0)), c.below, 2e-4 * c.below) << c.directNormal;
        EXPECT_NEAR(sky.luminance(towards(-c.sunZenith)) / sky.luminance(towards(0)), c.opposite, 2e-4 * c.opposite);
        EXPECT_EQ(sky.luminance({1, 0, -1e-9}), 0);
    }
}

// What the papers say of skies: an overcast one falls towards the horizon, a clear one rises, and is brightest around
// the sun.
TEST(PerezSky, LooksOvercastAndClear) {
    const PerezSky overcast = skyOf(cases[0]), clear = skyOf(cases[4]);
    EXPECT_LT(overcast.luminance(towards(-85)), overcast.luminance(towards(0)));
    EXPECT_GT(clear.luminance(towards(-85)), clear.luminance(towards(0)));
    EXPECT_GT(clear.luminance(towards(35)), 5 * clear.luminance(towards(-35)));
}

// 1990, figures: some 105 to 125 lm/W of an overcast sky, 130 to 145 of a blue one, and 95 to 105 of the sun's own
// light.
TEST(PerezSky, EfficaciesAreThoseOfSkyAndSun) {
    EXPECT_NEAR(skyOf(cases[0]).diffuseEfficacy(), 97.24 - 0.46 * 2.0036 + 12 * 0.5 - 8.91 * std::log(0.14578), 0.01);
    EXPECT_NEAR(skyOf(cases[4]).diffuseEfficacy(), 137, 3);
    EXPECT_NEAR(skyOf(cases[4]).directEfficacy(), 103, 2);
}

TEST(PerezSky, IlluminancesHaveTheirRadiation) {
    for (const Case& c : cases) {
        const PerezSky sky = skyOf(c);
        const Radiation found =
            radiationOfIlluminances(sky.directEfficacy() * c.directNormal, sky.diffuseEfficacy() * c.diffuseHorizontal,
                                    {0, 0, 11, 1}, towards(c.sunZenith));
        EXPECT_NEAR(found.directNormal, c.directNormal, 0.01 * c.directNormal + 1e-6);
        EXPECT_NEAR(found.diffuseHorizontal, c.diffuseHorizontal, 0.01 * c.diffuseHorizontal);
    }
}

TEST(SunNearness, IsGreatestInJanuary) {
    EXPECT_NEAR(sunNearness({2023, 1, 3, 12, 0}), 1.035, 1e-3);
    EXPECT_NEAR(sunNearness({2023, 7, 4, 12, 0}), 0.9666, 1e-3);
}

// --- weather files ---

const std::string head =
    "LOCATION,Hannover,NI,DEU,made up,103380,52.37,9.73,1.0,55.0\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME "
    "PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,made up\n"
    "COMMENTS 2\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
std::string hourLine(int hour, const std::string& direct, const std::string& diffuse,
                     const std::string& year = "2005") {
    return year + ",6,21," + std::to_string(hour) + ",60,?9,21.0,12.5,60,101300,1200,1330,340,600," + direct + ',' +
           diffuse + ",0,0,0,0,180,3.0,5,5,20,2000,9,999999999,15,0.1,0,88,0,0,0\n";
}
const std::string weather = head + hourLine(11, "350", "280") + hourLine(12, "420.5", "300") +
                            hourLine(13, "9999", "1") + hourLine(24, "0", "0");

TEST(WeatherFile, GivesTheHourAskedFor) {
    const WeatherHour hour = readWeatherHour("w.epw", weather, 6, 21, 12, {"scene.xml", 1, 1});
    EXPECT_EQ(hour.place.latitude, 52.37);
    EXPECT_EQ(hour.place.longitude, 9.73);
    EXPECT_EQ(hour.time.zone, 1);
    EXPECT_EQ(hour.time.year, 2005);
    EXPECT_EQ(hour.time.hour, 11.5) << "the middle of the hour";
    EXPECT_EQ(hour.radiation.directNormal, 420.5);
    EXPECT_EQ(hour.radiation.diffuseHorizontal, 300);
    EXPECT_EQ(hour.radiation.dewPoint, 12.5);
}

// As files of several programs have it; EnergyPlus takes them too.
TEST(WeatherFile, OtherLayoutsAreRead) {
    const auto read = [](const std::string& content) {
        return readWeatherHour("w.epw", content, 6, 21, 12, {"scene.xml", 1, 1});
    };
    const auto with = [](const std::string& from, const std::string& to) {
        std::string content = weather;
        return content.replace(content.find(from), from.size(), to);
    };
    for (const std::string& content : {"\xef\xbb\xbf" + weather, with("LOCATION", "Location"),
                                       with("COMMENTS 2", "in two lines\n\nCOMMENTS 2"), with("COMMENTS 2\n", "")})
        EXPECT_EQ(read(content).radiation.directNormal, 420.5) << content.substr(0, 400);
    for (const char* year : {"0", "9999", " "})
        EXPECT_EQ(read(head + hourLine(12, "420.5", "300", year)).time.year, 2006) << year;
    for (const char* dewPoint : {",99.9,", ",999,", ",,"}) {
        std::string content = head + hourLine(12, "420.5", "300");
        EXPECT_EQ(read(content.replace(content.find(",12.5,"), 6, dewPoint)).radiation.dewPoint, Radiation{}.dewPoint);
    }
    EXPECT_THROW(read(head + hourLine(12, "99999", "300")), InputError) << "missing";
}

// Cut off anywhere, and with bytes changed at random: read, or an error that names the file, and no number that is not
// finite.
TEST(WeatherFile, AnyContentIsReadOrRefused) {
    uint32_t state = 1;
    const auto random = [&](size_t below) { return (state = state * 1664525 + 1013904223) / 65536 % below; };
    int readable = 0;
    for (size_t k = 0; k < 4000; ++k) {
        std::string content = weather;
        if (k < weather.size())
            content.resize(k);
        else
            for (int n = 0; n < 3; ++n) content[random(content.size())] = static_cast<char>(random(256));
        try {
            const WeatherHour hour = readWeatherHour("w.epw", content, 6, 21, 12, {"scene.xml", 1, 1});
            EXPECT_TRUE(std::isfinite(hour.radiation.directNormal + hour.radiation.diffuseHorizontal +
                                      hour.radiation.dewPoint + hour.place.latitude + hour.time.hour));
            ++readable;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::AnyOf(HasSubstr("w.epw"), HasSubstr("scene.xml:1:1")));
        }
    }
    EXPECT_GT(readable, 1000);
}

// --- the emitter ---

std::string perez(const std::string& parameters) {
    return "<emitter type=\"quasilux_perez_sky\">\n" + parameters + "</emitter>";
}
std::string measured(double direct, double diffuse) {
    return fmt::format(
        "<vector name=\"sun_direction\" value=\"0.4,-0.5,0.7\"/><float name=\"direct_normal_irradiance\" "
        "value=\"{}\"/><float name=\"diffuse_horizontal_irradiance\" value=\"{}\"/>",
        direct, diffuse);
}

/// By the sky's image alone.
double luxOnGround(const Scene& scene) {
    const dvec3 irradiance = irradianceOfGround(scene.surroundings.value().image.value());
    return luminousEfficacy * luminanceOf(irradiance.x, irradiance.y, irradiance.z);
}

TEST(PerezSkyEmitter, SkyAndSunHaveTheirIlluminances) {
    test::SceneFiles files;
    const dvec3 sun = glm::normalize(dvec3(0.4, -0.5, 0.7));
    for (const auto& [direct, diffuse] : {std::pair{0.0, 120.0}, {150.0, 250.0}, {400.0, 200.0}, {850.0, 95.0}}) {
        const PerezSky sky({direct, diffuse, 11, 1}, sun);
        const Scene scene = loadScene(files.write("scene.xml", test::sceneWith(perez(measured(direct, diffuse)))));
        EXPECT_NEAR(luxOnGround(scene) / (sky.diffuseEfficacy() * diffuse), 1, 5e-4) << direct;
        ASSERT_EQ(scene.directionalEmitters.size(), direct > 0 ? 1u : 0u);
        if (direct == 0) continue;
        const DirectionalEmitter& emitter = scene.directionalEmitters.front();
        EXPECT_NEAR(luminousEfficacy * emitter.irradiance.g / (sky.directEfficacy() * direct), 1, 1e-5);
        EXPECT_NEAR(glm::length(dvec3(emitter.direction) + sun), 0, 1e-6);
    }
    const Scene stated = loadScene(files.write(
        "scene.xml", test::sceneWith(perez(measured(400, 200) +
                                           "<float name=\"diffuse_horizontal_illuminance\" value=\"21000\"/><float "
                                           "name=\"direct_normal_illuminance\" value=\"33000\"/>"))));
    EXPECT_NEAR(luxOnGround(stated), 21000, 10);
    EXPECT_NEAR(luminousEfficacy * stated.directionalEmitters.at(0).irradiance.g, 33000, 1);
    const Scene byLux = loadScene(files.write(
        "scene.xml",
        test::sceneWith(
            perez("<vector name=\"sun_direction\" value=\"0.4,-0.5,0.7\"/><float name=\"direct_normal_illuminance\" "
                  "value=\"33000\"/><float name=\"diffuse_horizontal_illuminance\" value=\"21000\"/>"))));
    EXPECT_NEAR(luxOnGround(byLux), 21000, 10);
    EXPECT_NEAR(luminousEfficacy * byLux.directionalEmitters.at(0).irradiance.g, 33000, 1);
    const Scene noSun = loadScene(files.write(
        "scene.xml", test::sceneWith(perez(measured(400, 200) + "<boolean name=\"sun\" value=\"false\"/>"))));
    EXPECT_TRUE(noSun.directionalEmitters.empty());
}

TEST(PerezSkyEmitter, WeatherIsWhatItSays) {
    test::SceneFiles files;
    files.write("hannover.epw", weather);
    const Scene byFile = loadScene(files.write(
        "scene.xml", test::sceneWith(perez("<string name=\"weather\" value=\"hannover.epw\"/><integer name=\"month\" "
                                           "value=\"6\"/><integer name=\"day\" value=\"21\"/><integer name=\"hour\" "
                                           "value=\"12\"/>"))));
    const Scene byHand = loadScene(files.write(
        "scene.xml",
        test::sceneWith(perez("<float name=\"latitude\" value=\"52.37\"/><float name=\"longitude\" value=\"9.73\"/>"
                              "<float name=\"timezone\" value=\"1\"/><integer name=\"year\" value=\"2005\"/>"
                              "<integer name=\"month\" value=\"6\"/><integer name=\"day\" value=\"21\"/><float "
                              "name=\"hour\" value=\"11.5\"/><float name=\"dew_point\" value=\"12.5\"/><float "
                              "name=\"direct_normal_irradiance\" value=\"420.5\"/><float "
                              "name=\"diffuse_horizontal_irradiance\" value=\"300\"/>"))));
    EXPECT_DOUBLE_EQ(luxOnGround(byFile), luxOnGround(byHand));
    const glm::vec3 direction = byFile.directionalEmitters.at(0).direction;
    EXPECT_EQ(direction, byHand.directionalEmitters.at(0).direction);
    // Noon of solar time is 12:23 there: half an hour before, the sun is in the south-south-east, 60 degrees high.
    EXPECT_LT(direction.x, 0) << "light from the east travels to the west";
    EXPECT_GT(direction.y, 0);
    EXPECT_NEAR(std::asin(-direction.z) / degree, 59.5, 0.7);
}

TEST(PerezSkyEmitter, SaysWhatIsWrong) {
    test::SceneFiles files;
    files.write("w.epw", weather);
    files.write("short.epw", head + "2005,6,21,12,60\n");
    files.write("word.epw", head + hourLine(12, "much", "1"));
    files.write("negative.epw", head + hourLine(12, "5", "-1"));
    std::string halves = weather;
    halves.replace(halves.find("PERIODS,1,1"), 11, "PERIODS,1,2");
    files.write("halves.epw", halves);
    files.write("no.epw", "DATA\n");
    files.write("empty.epw", "");
    files.write("headless.epw", head.substr(0, head.find("DATA")) + hourLine(12, "5", "5"));
    const auto file = [](const std::string& name, int hour) {
        return "<string name=\"weather\" value=\"" + name +
               "\"/>\n<integer name=\"month\" value=\"6\"/><integer name=\"day\" value=\"21\"/><integer name=\"hour\" "
               "value=\"" +
               std::to_string(hour) + "\"/>";
    };
    const std::pair<std::string, std::vector<std::string>> errors[] = {
        {"", {"scene.xml:4:1", "needs the sun"}},
        {"<vector name=\"sun_direction\" value=\"0,0,1\"/>", {"needs direct_normal_irradiance"}},
        {measured(-1, 100), {"scene.xml:5:", "direct_normal_irradiance"}},
        {measured(100, 0), {"scene.xml:5:", "diffuse_horizontal_irradiance"}},
        {"<float name=\"latitude\" value=\"50\"/><float name=\"direct_normal_irradiance\" value=\"1\"/><float "
         "name=\"diffuse_horizontal_irradiance\" value=\"1\"/>",
         {"scene.xml:5:1", "has latitude but no longitude"}},
        {measured(1, 1) + "\n<float name=\"hour\" value=\"12\"/>", {"scene.xml:6:1", "both sun_direction and hour"}},
        {measured(1, 1) + "\n<float name=\"dew_point\" value=\"285\"/>",
         {"scene.xml:6:1", "'dew_point' is 285; expected -90 to 70"}},
        {"<vector name=\"sun_direction\" value=\"0,0,1\"/><float name=\"direct_normal_illuminance\" "
         "value=\"1\"/><float "
         "name=\"diffuse_horizontal_illuminance\" value=\"1\"/>\n<float name=\"direct_normal_irradiance\" "
         "value=\"1\"/>",
         {"scene.xml:6:1", "has direct_normal_irradiance alone"}},
        {"<string name=\"weather\" value=\"w.epw\"/>", {"say month, day and hour"}},
        {file("w.epw", 12) + "<float name=\"latitude\" value=\"50\"/>", {"both weather and latitude"}},
        {file("w.epw", 25), {"'hour' is 25; expected 1 to 24"}},
        {file("w.epw", 10), {"scene.xml:5:1", "has no hour 10 of day 21 of month 6"}},
        {file("w.epw", 13), {"w.epw:11:1", "direct normal radiation is missing"}},
        {file("w.epw", 24), {"below the horizon"}},
        {file("short.epw", 12), {"short.epw:9:1", "has 5 fields"}},
        {file("word.epw", 12), {"word.epw:9:1", "much"}},
        {file("negative.epw", 12), {"negative.epw:9:1", "diffuse horizontal radiation is -1"}},
        {file("halves.epw", 12), {"halves.epw:8:1", "the file has 2 records an hour; expected one"}},
        {file("no.epw", 12), {"no.epw:1:1", "begins with LOCATION"}},
        {file("headless.epw", 12), {"headless.epw:1:1", "no line DATA PERIODS"}},
        {file("empty.epw", 12), {"begins with LOCATION"}},
        {file("none.epw", 12), {"scene.xml:5:1", "none.epw"}},
        {measured(1, 1) + "<float name=\"dewpoint\" value=\"1\"/>", {"Did you mean 'dew_point'"}}};
    test::expectErrors(files, errors, perez);
}

} // namespace
} // namespace quasilux
