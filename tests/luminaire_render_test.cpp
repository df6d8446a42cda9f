// Luminaires in scenes: lux against the inverse-square law, the same by photons, and the same lumens give the same lux
// whatever carries them.
// Renders with a noise are held to 4 standard errors of 10 batches (Student t: 0.3 % each) or 3 of a meter. Seeds are
// fixed.
#include "output/meter_reading.h"
#include "support/luminaire_files.h"
#include "support/meter_readings.h"
#include "support/shared_features.h"
#include "support/wrong_learning.h"
#include "util/temporary_folder.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;
constexpr double degree = pi / 180;

/// Looks down from a height, turned about the vertical. `place` is "x,y,z"; `scale` is of to_world and is to change
/// nothing.
std::string hanging(const std::string& file, const std::string& place, double turn, const std::string& more = "",
                    double scale = 1) {
    return fmt::format(R"(<emitter type="quasilux_ies"><string name="filename" value="{}"/>{}<transform name="to_world">
        <scale value="{}"/><rotate x="1" angle="180"/><rotate z="1" angle="{}"/><translate value="{}"/></transform></emitter>)",
                       file, more, scale, turn, place);
}

/// Lux at the points of the scene's grid.
std::vector<double> luxOf(Scene scene, unsigned passes = 1) {
    useGridsAsSensor(scene);
    RenderSettings settings;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = 1000;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    EXPECT_EQ(renderer.counters().nonFinite, 0u);
    const FilmImage image = renderer.develop();
    std::vector<double> lux;
    for (size_t k = 0; k < image.radiance.size() / 3; ++k)
        lux.push_back(readingOf(image, k, scene.settings.units == Units::photometric).photometricValue);
    return lux;
}

const std::string floorGrid =
    R"(<?quasilux illuminance-grid origin="-2,-1.6,0" edge-u="5,0,0" edge-v="0,4,0" nx="5" ny="4"?>)";
dvec3 floorPoint(size_t k) { return {-1.5 + double(k % 5), -1.1 + double(k / 5), 0}; }

TEST(LuminaireRender, LuxAreThoseOfTheInverseSquareLaw) {
    constexpr double turn = 30;
    const dvec3 place(0.2, 0.1, 2);
    test::IesText lobed; // towards C90
    lobed.vertical = {0, 30, 60, 90};
    lobed.horizontal = {0, 90, 180, 270, 360};
    lobed.candela = [](double v, double h) { return h == 90 ? 1000 - 5 * v : 100; };
    const TemporaryFolder folder;
    const std::string lobedFile = (folder.path() / "lobed.ies").string();
    std::ofstream(lobedFile) << lobed.text();
    for (const std::string name : {"isotropic100", "lambert1000", "spot_cos40", "asym_cosphi", "quadrant", "lobed"}) {
        const std::string file = name == "lobed" ? lobedFile : test::luminaireFolder + name + ".ies";
        const Goniogram goniogram = readGoniogram(file, {});
        const auto lux = luxOf(test::meterScene(hanging(file, "0.2,0.1,2", turn) + floorGrid));
        ASSERT_EQ(lux.size(), 20u);
        size_t lit = 0, mirrored = 0;
        for (size_t k = 0; k < lux.size(); ++k) {
            // C0 lies along world +x turned by `turn`, and C runs counter-clockwise seen from above.
            const dvec3 offset = floorPoint(k) - place;
            const double c = std::atan2(offset.y, offset.x) / degree - turn, distance = glm::length(offset);
            const double gamma = std::acos(-offset.z / distance) / degree;
            const double truth =
                goniogram.intensity(directionAt(c, gamma)) * std::cos(gamma * degree) / (distance * distance);
            EXPECT_NEAR(lux[k], truth, 0.002 * truth + 1e-9 * goniogram.largest()) << name << ", point " << k;
            // And by the closed forms, where lines between the angles of the file are as near.
            const double cosine = std::cos(gamma * degree), law = cosine / (distance * distance);
            if (name == "isotropic100") {
                EXPECT_NEAR(lux[k], 100 * law, 0.002 * truth);
            }
            if (name == "lambert1000") {
                EXPECT_NEAR(lux[k], 1000 * cosine * law, 0.002 * truth);
            }
            lit += truth > 1e-3 ? 1 : 0;
            mirrored += std::abs(goniogram.intensity(directionAt(-c, gamma)) * law - truth) > 0.02 * truth ? 1 : 0;
        }
        EXPECT_GT(lit, 5u) << name;
        if (name == "lobed") {
            EXPECT_GT(mirrored, 10u) << "negative control: C the other way round would be noticed";
        }
    }
}

/// Lux of a small meter at the origin that faces the lamp at height `distance`.
double luxBelow(const std::string& lamp, double size, unsigned passes, const std::string& settings = "") {
    const std::string grid =
        fmt::format(R"(<?quasilux illuminance-grid origin="{0},{0},0" edge-u="{1},0,0" edge-v="0,{1},0" nx="1"
        ny="1"?>)",
                    -size / 2, size);
    return luxOf(test::meterScene(settings + lamp + grid), passes).at(0);
}

TEST(LuminaireRender, TheSameLumensGiveTheSameLuxWhateverCarriesThem) {
    const std::string lambert = test::luminaireFolder + "lambert1000.ies",
                      isotropic = test::luminaireFolder + "isotropic100.ies";
    const std::string lumens = "<float name=\"lumens\" value=\"100\"/>";
    // A small Lambertian square: 100 lm / (pi area).
    for (const double unit : {1.0, 0.001, 1000.0}) { // metres
        const double metre = 1 / unit, side = 0.01 * metre;
        const std::string inUnits = lumens + fmt::format("<float name=\"metres_per_unit\" value=\"{}\"/>", unit);
        const std::string place = fmt::format("0,0,{}", metre);
        const double area =
            luxBelow(test::squareLight(side, fmt::format("z=\"{}\"", metre), 100 / (683 * pi * 1e-4)), side, 16);
        EXPECT_NEAR(area, 31.83, 0.02) << "a square, unit " << unit;
        const double point = luxBelow(
            fmt::format(
                R"(<emitter type="point"><rgb name="intensity" value="{}"/><point name="position" value="0,0,{}"/></emitter>)",
                100 * metre * metre / (4 * pi * 683), metre),
            side, 1);
        EXPECT_NEAR(point, 7.958, 0.002) << "a point, unit " << unit;
        for (const double scale : {1.0, 0.1, 20.0}) {
            EXPECT_NEAR(luxBelow(hanging(lambert, place, 40, inUnits, scale), side, 1), 31.83, 0.02)
                << unit << " " << scale;
            EXPECT_NEAR(luxBelow(hanging(isotropic, place, 40, inUnits, scale), side, 1), 7.958, 0.002)
                << unit << " " << scale;
        }
    }
    const std::string photometric = "<?quasilux units=\"photometric\"?>";
    EXPECT_NEAR(luxBelow(hanging(lambert, "0,0,1", 0, lumens), 0.01, 1, photometric), 31.83, 0.02);
    EXPECT_NEAR(
        luxBelow(hanging(lambert, "0,0,1", 0, lumens + "<float name=\"colour_temperature\" value=\"3000\"/>"), 0.01, 1),
        31.83, 0.02)
        << "a colour changes no lux";
}

/// A floor of albedo 0.5 under a luminaire at height 2; the image shows [-1, 1]^2 of it.
Scene floorUnder(const std::string& file, const std::string& more = "") {
    return test::meterScene(
        R"(<integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <rotate y="1" angle="180"/><translate z="5"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>)" +
        hanging(file, "0.3,0,2", 20, more) +
        R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/></transform><bsdf type="diffuse"/></shape>)");
}

/// Mean radiance there: albedo / pi times I cos / distance^2 / 683, where light leaves from places within `half` of the
/// centre along x.
double floorRadiance(const Goniogram& goniogram, double half = 0) {
    constexpr int n = 200, places = 16;
    double sum = 0;
    for (int p = 0; p < (half > 0 ? places : 1); ++p) {
        const double along = half > 0 ? half * (2 * (p + 0.5) / places - 1) : 0;
        const dvec3 from(0.3 + along * std::cos(20 * degree), along * std::sin(20 * degree), 2);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const dvec3 offset = dvec3(2 * (i + 0.5) / n - 1, 2 * (j + 0.5) / n - 1, 0) - from;
                const double distance = glm::length(offset), cosine = 2 / distance;
                const dvec3 direction =
                    directionAt(std::atan2(offset.y, offset.x) / degree - 20, std::acos(cosine) / degree);
                sum += goniogram.intensity(direction) * cosine / (distance * distance);
            }
    }
    return 0.5 / pi / 683 * sum / (n * n * (half > 0 ? places : 1));
}

TEST(LuminaireRender, PhotonsAndDirectLightAgreeWhateverWasLearned) {
    for (const char* name : {"asym_cosphi", "spot_cos40"}) {
        const std::string file = test::luminaireFolder + name + ".ies";
        expectMeanOfImage(floorUnder(file), floorRadiance(readGoniogram(file, {})));
    }
}

TEST(LuminaireRender, ALongLuminaireShinesFromAllOfIt) {
    test::IesText ies;
    ies.size = "0 3 0"; // a line along C0
    ies.vertical = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90};
    ies.candela = [](double v, double) { return 1000 * std::pow(std::cos(v * degree), 8); };
    test::SceneFiles files;
    const std::string file = files.write("line.ies", ies.text());
    const Goniogram goniogram = readGoniogram(file, {});
    expectMeanOfImage(floorUnder(file), floorRadiance(goniogram, 1.5));
    EXPECT_GT(std::abs(floorRadiance(goniogram, 1.5) / floorRadiance(goniogram) - 1), 0.1) << "a point would show";
}

/// A luminaire in a box that is open below: photons learn the opening.
TEST(LuminaireRender, LightComesThroughAnOpeningAsTheLawHasIt) {
    const std::string file = test::luminaireFolder + "asym_cosphi.ies";
    // The hole of 0.8 by 0.8 in a black lid at height 1 lets what goes to [-1.3, 1.9]^2 on the floor pass: all of the
    // image.
    std::string lid;
    for (const char* part :
         {"<scale x=\"2\" y=\"4\"/><translate x=\"-2.5\"/>", "<scale x=\"2\" y=\"4\"/><translate x=\"3.1\"/>",
          "<scale x=\"0.8\" y=\"2\"/><translate x=\"0.3\" y=\"2.8\"/>",
          "<scale x=\"0.8\" y=\"2\"/><translate x=\"0.3\" y=\"-2.8\"/>"})
        lid += fmt::format(
            R"(<shape type="rectangle"><transform name="to_world">{}<translate z="1"/></transform>{}</shape>)", part,
            test::diffuse(0));
    const Scene scene =
        test::meterScene(R"(<integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <rotate y="1" angle="180"/><translate z="0.9"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>)" +
                         hanging(file, "0.3,0,2", 20) + lid +
                         R"(<shape type="rectangle"><transform name="to_world"><scale value="4"/></transform>
        <bsdf type="diffuse"/></shape>)");
    expectMeanOfImage(scene, floorRadiance(readGoniogram(file, {})));
}

} // namespace
} // namespace quasilux
