// Scenes at the ends of single precision: sizes, places, thin panes, slivers, narrow lobes, extreme emitters. None may
// give a sample that is not finite, each must balance its energy to 1e-4, and place, size and units must not change the
// image by more than 0.5 %.
//
// Where two renders of the same seed are compared, nearly all paths are the same, so the bound is no statistical one.
// Where a closed form is known, a right render passes within 0.5 % or 3 standard errors (from 10 batches: two-sided
// Student t, 1.5 % a case); seeds are fixed.
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"
#include "util/temporary_folder.h"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace quasilux {
namespace {

constexpr double bound = 0.005, balanceBound = 1e-4;
using std::numbers::pi;

const Placement ordinary, turned{"Turned", 1, "0,0,0", true};
const Placement placements[] = {{"FarAway", 1, "1e5,-1e5,5e4"}, {"FarAwayTurned", 1, "-1e5,3e4,1e5", true},
                                {"Tiny", 1e-4, "0,0,0"},        {"TinyFarAway", 1e-4, "10,-10,5"},
                                {"Huge", 1e5, "0,0,0"},         {"HugeTurned", 1e5, "1e5,2e5,-1e5", true}};
std::string placementName(const testing::TestParamInfo<Placement>& info) { return info.param.name; }

RenderSettings countingSettings(unsigned photons) {
    RenderSettings settings;
    settings.energyBalance = true;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = photons;
    return settings;
}

void expectSound(const RenderCounters& counters) {
    EXPECT_EQ(counters.nonFinite, 0u);
    ASSERT_TRUE(counters.energy);
    EXPECT_LE(std::abs(counters.energy->imbalance()), balanceBound);
    if (counters.energy->emitted > 0) {
        EXPECT_NEAR(counters.energy->emitted / counters.fluxEmitted, 1, balanceBound);
    }
}

/// Luminance of 4 x 4 equal blocks of the image, checked on the way.
std::vector<double> blocks(const Scene& scene, const RenderSettings& settings, unsigned passes) {
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    expectSound(renderer.counters());
    const auto image = renderer.develop();
    std::vector<double> mean(16);
    for (unsigned y = 0; y < image.height; ++y)
        for (unsigned x = 0; x < image.width; ++x) {
            const float* rgb = image.radiance.data() + 3 * (size_t(y) * image.width + x);
            mean[y * 4 / image.height * 4 + x * 4 / image.width] +=
                (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) * 16 / (image.width * image.height);
        }
    return mean;
}

/// Largest relative difference of a block.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = 0;
    for (size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]) / std::abs(b[k]));
    return largest;
}

const char* const narrowPhong = R"(<bsdf type="phong"><rgb name="diffuse_reflectance" value="0.3"/>
    <rgb name="specular_reflectance" value="0.5"/><float name="exponent" value="1e5"/></bsdf>)";
const char* const narrowGgx = R"(<bsdf type="roughconductor"><string name="material" value="none"/>
    <string name="distribution" value="ggx"/><float name="alpha" value="1e-3"/></bsdf>)";
const char* const wideGgx = R"(<bsdf type="roughconductor"><string name="material" value="none"/>
    <string name="distribution" value="ggx"/><float name="alpha" value="1"/></bsdf>)";

// ---- place, size, units ----------------------------------------------------------------------------------------

class Placed : public testing::TestWithParam<Placement> {};
INSTANTIATE_TEST_SUITE_P(HardCases, Placed, testing::ValuesIn(placements), placementName);

std::vector<double> room(const Placement& placement, const RenderSettings& settings, const char* ball) {
    return blocks(placedScene(roomText(ball), placement), settings, 6);
}

RenderSettings roomSettings(bool byPhotons) {
    auto settings = countingSettings(4000);
    if (!byPhotons) return settings;
    settings.map = MapOrder::camera;
    settings.bdd = 1;
    settings.direct = DirectLight::photons;
    return settings;
}

/// The room in its own place, made once for all placements.
const std::vector<double>& roomAtHome(bool isTurned, bool byPhotons) {
    static std::map<std::pair<bool, bool>, std::vector<double>> rooms;
    auto& blocks = rooms[{isTurned, byPhotons}];
    if (blocks.empty()) blocks = room(isTurned ? turned : ordinary, roomSettings(byPhotons), narrowPhong);
    return blocks;
}

TEST_P(Placed, ARoomLooksTheSame) {
    for (const bool byPhotons : {false, true}) {
        const auto found = room(GetParam(), roomSettings(byPhotons), narrowPhong);
        // Local frames turn otherwise than the scene.
        EXPECT_LE(difference(found, roomAtHome(GetParam().turned, byPhotons)), bound) << byPhotons;
    }
}

// Control: a renderer that takes the coordinates as they are would fail the test above.
TEST(HardCasesControl, CoordinatesInSinglePrecisionAreFound) {
    Scene moved = placedScene(roomText(narrowPhong), ordinary);
    moveInSinglePrecision(moved, {1e5f, -1e5f, 5e4f});
    EXPECT_GT(difference(blocks(moved, roomSettings(false), 6), roomAtHome(false, false)), bound);
}

// Fresnel's formulas for unpolarised light at every hit, all internal reflections: T = (1 - R) / (1 + R) (Born & Wolf).
TEST_P(Placed, AThinPaneTransmits) {
    RenderSettings settings;
    settings.furtherFeatures = test::surfaceFeatures();
    const std::pair<double, double> cases[] = {
        {0, .923077}, {45, .904327}, {60, .836232}, {75, .596092}, {85, .240080}};
    for (const auto& [degrees, transmittance] : cases) {
        const double angle = degrees * pi / 180;
        const std::string text =
            orthographicSensor(fmt::format("{},0,{}", 10 * std::sin(angle), 10 * std::cos(angle)), "0,0,0", 0.2, 64) +
            R"(
<shape type="cube"><transform name="to_world"><scale x="20" y="20" z="0.5e-3"/></transform><bsdf type="dielectric">
    <float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="60"/><translate z="-1"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>)";
        const auto result =
            renderGroups(placedScene(text, GetParam()), settings, std::vector<int>(64 * 64, 0), 10, 4).front();
        EXPECT_NEAR(result.mean, transmittance, std::max(bound * transmittance, 3 * result.standardError)) << degrees;
        EXPECT_LT(result.standardError, 0.004) << "too noisy to decide anything";
    }
}

/// A lamp 1e-3 above a floor, both `width` wide.
std::string closeLamp(double width) {
    return orthographicSensor("0.1,0.2,5e-4", "0.1,0.2,0", 0.5, 16) + fmt::format(R"(
<shape type="rectangle"><transform name="to_world"><scale value="{0}"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="{0}"/><rotate x="1" angle="180"/><translate z="1e-3"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="2"/></emitter></shape>)",
                                                                                  width / 2);
}

// The irradiance is pi L, and no photon starts behind the floor or misses it. Out of the axes single precision knows
// places on a floor 2000 wide to 1e-3 only.
TEST_P(Placed, ALampCloseToAFloor) {
    const auto result =
        renderGroups(placedScene(closeLamp(200), GetParam()), countingSettings(1000), std::vector<int>(256, 0), 10, 40)
            .front();
    EXPECT_NEAR(result.mean, 1, std::max(bound, 3 * result.standardError));
    EXPECT_LT(result.standardError, 0.003) << "too noisy to decide anything";
    Renderer renderer(testDevice(), placedScene(closeLamp(GetParam().turned ? 200 : 2000), GetParam()),
                      countingSettings(20'000));
    renderer.renderPass(0);
    const EnergyBalance& energy = *renderer.counters().energy;
    EXPECT_LT(energy.escaped / energy.emitted, GetParam().turned ? 1e-3 : balanceBound);
    EXPECT_NEAR(energy.absorbed / energy.emitted, 1, 0.02);
}

// A lamp 1e-3 above the plane of the floor that it lights: E = I h / d^3.
TEST_P(Placed, GrazingLight) {
    const double h = 1e-3;
    const std::string text = orthographicSensor("1,0.2,1", "1,0.2,0", 0.01, 16) + R"(
<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
<emitter type="point"><transform name="to_world"><translate z="1e-3"/></transform><rgb name="intensity" value="1"/></emitter>)";
    const double scale = GetParam().scale;
    const double expected = 0.5 / pi * h / std::pow(1 + 0.04 + h * h, 1.5) / (scale * scale);
    double mean = 0;
    for (const double value : blocks(placedScene(text, GetParam()), countingSettings(1000), 2)) mean += value / 16;
    EXPECT_NEAR(mean / expected, 1, bound);
}

// ---- lobes, emitters, media --------------------------------------------------------------------------------------

TEST(HardCases, NarrowAndWideLobesAreSound) {
    for (const char* ball : {narrowPhong, narrowGgx, wideGgx})
        for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
            auto settings = countingSettings(3000);
            settings.direct = direct;
            settings.bdd = 1;
            room(ordinary, settings, ball);
            settings.quasiSpecular = "none";
            settings.quasiSpecularOverridesScene = true;
            room(ordinary, settings, ball);
        }
}

// A lossless near-mirror in a uniform sky is not to be seen.
TEST(HardCases, ANearMirrorInAUniformSky) {
    const std::string text = orthographicSensor("0,0,3", "0,0,0", 0.9, 16) +
                             R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
<shape type="sphere"><transform name="to_world"></transform>)" +
                             narrowGgx + "</shape>";
    const auto result =
        renderGroups(placedScene(text, ordinary), countingSettings(4000), std::vector<int>(256, 0), 10, 20).front();
    EXPECT_NEAR(result.mean, 1, std::max(bound, 3 * result.standardError));
    EXPECT_LT(result.standardError, 0.005) << "too noisy to decide anything";
}

// Lossless, so radiance 1 everywhere: optical depths 1e-3 and 100, peaks both ways and exactly none.
TEST(HardCases, LosslessMediaInAUniformSky) {
    struct Case {
        double sigmaT, g;
    };
    for (const Case c : {Case{5e-4, 0}, Case{50, 0}, Case{2, 0.99}, Case{2, -0.99}}) {
        const std::string text = orthographicSensor("0,0,3", "0,0,0", 0.6, 8) +
                                 fmt::format(R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
<shape type="sphere"><transform name="to_world"></transform><bsdf type="null"/>
<medium name="interior" type="homogeneous"><rgb name="sigma_t" value="{}"/><float name="albedo" value="1"/>
<phase type="hg"><float name="g" value="{}"/></phase></medium></shape>)",
                                             c.sigmaT, c.g);
        const Scene scene = placedScene(text, ordinary);
        Renderer renderer(testDevice(), scene, countingSettings(2000));
        renderer.renderPass(0);
        expectSound(renderer.counters());
        auto settings = countingSettings(2000);
        settings.quasiSpecular =
            "all"; // no density estimate, whose kernel is wider than a mean free path in the densest
        settings.quasiSpecularOverridesScene = true;
        settings.variant = Variant::alternative;
        const auto result = renderGroups(scene, settings, std::vector<int>(64, 0), 10, 10).front();
        EXPECT_NEAR(result.mean, 1, std::max(bound, 3 * result.standardError)) << c.sigmaT << ' ' << c.g;
        EXPECT_LT(result.standardError, 0.015) << "too noisy to decide anything";
    }
}

TEST(HardCases, EmittersOfVeryDifferentRadiance) {
    const auto lamp = [](const char* radiance, const char* x) {
        return fmt::format(
            R"(<shape type="rectangle"><transform name="to_world"><scale value="0.1"/><translate x="{}" z="-0.95"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf><emitter type="area"><rgb name="radiance" value="{}"/></emitter></shape>)",
            x, radiance);
    };
    const auto measure = [&](const char* first, const char* second) {
        const auto text = roomText(wideGgx, lamp(first, "0.5") + lamp(second, "-0.5"));
        return renderGroups(placedScene(text, ordinary), countingSettings(4000), std::vector<int>(256, 0), 10, 2)
            .front();
    };
    const auto both = measure("1e6", "1e-6"), bright = measure("1e6", "1e-30");
    EXPECT_NEAR(both.mean, bright.mean, bound * bright.mean + 3 * std::hypot(both.standardError, bright.standardError));
    const auto text = roomText(wideGgx, lamp("1e6", "0.5") + lamp("1e-6", "-0.5"));
    blocks(placedScene(text, ordinary), countingSettings(4000), 2);
}

// ---- bad geometry --------------------------------------------------------------------------------------------------

/// A floor of [-1, 1]^2 as an OBJ file, under a lamp and beside a wall, so that direct and diffuse light fall on it.
std::vector<double> floorImage(const std::string& obj, const std::string& extra = "") {
    const test::SceneFiles files;
    const auto mesh = files.write("floor.obj", obj);
    const std::string text =
        orthographicSensor("0,0,3", "0,0,0", 0.9, 16) +
        fmt::format(R"(<shape type="obj"><string name="filename" value="{}"/><boolean name="face_normals" value="true"/>
<transform name="to_world"></transform><bsdf type="diffuse" id="paper"><rgb name="reflectance" value="0.7"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="90"/><translate x="-1.2" z="0.5"/></transform>
    <bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf></bsdf></shape>
<emitter type="point"><transform name="to_world"><translate x="0.3" y="0.2" z="2"/></transform><rgb name="intensity" value="5"/></emitter>
)",
                    mesh) +
        extra;
    auto settings = countingSettings(20'000);
    settings.direct = DirectLight::photons;
    settings.radius = RadiusChoice::fixed; // the first radius follows the area, duplicates included, and so does blur
    return blocks(placedScene(text, ordinary), settings, 10);
}

const std::string floorCorners = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
const std::string plainFloor = floorCorners + "f 1 2 3\nf 1 3 4\n";

/// How far an image is from that of the plain floor.
double fromPlainFloor(const std::vector<double>& image) {
    static const auto plain = floorImage(plainFloor);
    return difference(image, plain);
}

TEST(BadGeometry, SliversDoNotShow) {
    std::string slivers = floorCorners;
    std::string faces = "f 1 2 3\n";
    constexpr int count = 4000; // needles from one corner to the opposite side, 2.8 long and down to 5e-4 wide
    for (int k = 0; k <= count; ++k) slivers += fmt::format("v {:.9g} 1 0\n", 1 - 2.0 * k / count);
    for (int k = 0; k < count; ++k) faces += fmt::format("f 1 {} {}\n", k + 5, k + 6);
    EXPECT_LE(fromPlainFloor(floorImage(slivers + faces)), bound);
}

TEST(BadGeometry, DegenerateTrianglesDoNotShow) {
    const std::string degenerate = plainFloor + "v 0 0 0\nv 0.5 0.5 0\nf 1 1 3\nf 5 5 5\nf 1 5 3\nf 1 5 6\n";
    EXPECT_LE(fromPlainFloor(floorImage(degenerate)), bound);
}

TEST(BadGeometry, DuplicatedTrianglesDoNotShow) {
    EXPECT_LE(fromPlainFloor(floorImage(plainFloor + "f 1 2 3\nf 1 3 4\n")), bound);
    EXPECT_LE(fromPlainFloor(floorImage(plainFloor + "f 3 1 2\nf 4 1 3\n")), bound);
}

// Two sheets of the same kind in one place, corner on corner, look like one. (Sheets that overlap in part do not, and
// are warned of: docs/method/density.md, borders_test.)
TEST(BadGeometry, DuplicatedSheetsDoNotShow) {
    const char* twin = R"(<shape type="rectangle"><transform name="to_world"></transform><ref id="paper"/></shape>)";
    EXPECT_LE(fromPlainFloor(floorImage(plainFloor, twin)), bound);
}

// ---- textures, classes ---------------------------------------------------------------------------------------------

TEST(HardCases, ATextureOfOnePixelIsAConstant) {
    const test::SceneFiles files;
    const auto image = [&](const std::string& reflectance) {
        const test::SceneFiles folder; // the same one, which placedScene has removed
        folder.write("pixel.ppm", std::string("P6\n1 1\n255\n") + char(51) + char(102) + char(204));
        return blocks(placedScene(orthographicSensor("0,0,3", "0,0,0", 0.9, 16) +
                                      R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
<shape type="rectangle"><transform name="to_world"></transform><bsdf type="diffuse">)" +
                                      reflectance + "</bsdf></shape>",
                                  ordinary),
                      countingSettings(1000), 2);
    };
    for (const char* filter : {"nearest", "bilinear"})
        EXPECT_LE(
            difference(image(fmt::format(R"(<texture name="reflectance" type="bitmap"><boolean name="raw" value="true"/>
<string name="filename" value="{}"/><string name="filter_type" value="{}"/></texture>)",
                                         files.path("pixel.ppm"), filter)),
                       image(R"(<rgb name="reflectance" value="0.2,0.4,0.8"/>)")),
            1e-5)
            << filter;
}

// A mirror where no light comes: caustic photons may exist, and none does.
TEST(HardCases, NoPhotonsOfAClass) {
    const std::string text = orthographicSensor("0,0,3", "0,0,0", 0.9, 16) + R"(
<emitter type="point"><transform name="to_world"><translate z="2"/></transform></emitter>
<shape type="rectangle"><transform name="to_world"><scale value="20"/></transform><bsdf type="diffuse"/></shape>
<shape type="sphere"><transform name="to_world"><scale value="0.1"/><translate z="-1"/></transform><bsdf type="conductor"/></shape>)";
    for (const auto map : {MapOrder::photons, MapOrder::camera}) {
        auto settings = countingSettings(3000);
        settings.map = map;
        for (const double value : blocks(placedScene(text, ordinary), settings, 2)) EXPECT_GT(value, 0);
    }
}

// A floor that goes on in another material: its photons lie on one half of the disc alone, or, where a texture bends the
// normals, carry other flux. Both halves have an edge in common and no corner between them.
TEST(HardCases, DiffuseFlushWithOtherMaterials) {
    const TemporaryFolder folder;
    const std::string flat = (folder.path() / "flat.ppm").string();
    std::ofstream(flat, std::ios::binary) << "P6 1 1 255\n"
                                          << "\x80\x80\xff";
    const std::string bent = R"(<bsdf type="normalmap"><texture name="normalmap" type="bitmap">
        <boolean name="raw" value="true"/><string name="filename" value=")" +
                             flat + R"("/></texture><bsdf type="diffuse"/></bsdf>)";
    const char* const black = R"(<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>)";
    const std::vector<std::string> others{R"(<bsdf type="diffuse"/>)", R"(<bsdf type="conductor"/>)", black,
                                          R"(<bsdf type="thindielectric"/>)", bent};
    for (const std::string& other : others) {
        const std::string text =
            orthographicSensor("-0.1,0,1", "-0.1,0,0", 0.1, 16) +
            R"(<emitter type="constant"/><shape type="rectangle"><transform name="to_world"><translate x="-1"/></transform>
            <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf></shape>
            <shape type="rectangle"><transform name="to_world"><translate x="1"/></transform>)" +
            other + "</shape>";
        RenderSettings settings = countingSettings(20000);
        settings.direct = DirectLight::photons;
        std::vector<int> beside(
            256, -1); // two columns nearer to the seam than the radius; the filter of the last ones looks beyond
        for (size_t row = 0; row < 16; ++row) beside[16 * row + 12] = beside[16 * row + 13] = 0;
        const auto found = renderGroups(placedScene(text, ordinary), settings, beside, 10, 40).front();
        EXPECT_NEAR(found.mean, 0.5, 3 * found.standardError + 0.0025) << other;
        EXPECT_LT(found.standardError, 0.015) << "too noisy to decide anything";
    }
}

// A floor beside a ball that is half sunk in it, in light that falls straight down. With 32 chords to its circle the floor
// within the chords' height of it was counted as lit: 8 % too dark here.
TEST(HardCases, AFloorAtTheFootOfABall) {
    const std::string text = orthographicSensor("1.0044,0.1239,3", "1.0044,0.1239,0", 0.012, 8) +
                             R"(<emitter type="directional"><vector name="direction" value="0,0,-1"/></emitter>
        <shape type="rectangle"><transform name="to_world"><scale value="2"/></transform><bsdf type="diffuse"/></shape>
        <shape type="sphere"><transform name="to_world"/><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>)";
    RenderSettings settings = countingSettings(20000);
    settings.direct = DirectLight::photons;
    settings.radiusScale = 0.3;
    std::vector<int> inside(64, 0); // the filter of the outermost pixels looks beyond
    for (size_t k = 0; k < 8; ++k) inside[8 * k] = inside[8 * k + 7] = -1;
    const auto found = renderGroups(placedScene(text, ordinary), settings, inside, 10, 200).front();
    EXPECT_NEAR(found.mean, 0.5 / pi, (3 * found.standardError + 0.005 * 0.5 / pi));
    EXPECT_LT(found.standardError, 0.01 * 0.5 / pi) << "too noisy to decide anything";
}

} // namespace
} // namespace quasilux
