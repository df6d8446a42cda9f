// Irradiance meters against closed forms, by every method. Sources: inverse square and cosine law; sphere, tilted plane
// under a sky: Howell, A Catalog of Radiation Heat Transfer Configuration Factors; rectangle: Lambert 1760, Photometria
// (contour integral, Baum, Rushmeier & Winget 1989); rectangles to each other: Howell C-11, C-14; integrating sphere:
// Goebel 1967; cube: matrix radiosity of 21 x 21 patches a face, extrapolated (uncertain by 5e-5).
//
// Where nothing is biased a reading passes within 3 of its own standard errors (two-sided, Student's t: 2 % of right
// readings would fail after 8 passes, 0.6 % after 24, 0.4 % after 60; about 100 readings are made, and the seed is
// fixed, so what passes goes on passing). After a density estimate,
// 0.3 % more are allowed for its radius. Each case must know its reading to 0.35 %, and each must find a light that is
// 2 % stronger wrong.
#include "support/meter_readings.h"
#include "support/render_statistics.h"
#include "support/wrong_rules.h"

#include <numbers>

namespace quasilux {
namespace {

using test::LawRule;

constexpr double pi = std::numbers::pi;
// ---- direct light ---------------------------------------------------------------------------------------------------

std::string sphereLight(double radius, const std::string& place) {
    return fmt::format(
        "<shape type=\"sphere\"><point name=\"center\" {}/><float name=\"radius\" value=\"{}\"/>{}</shape>", place,
        radius, test::areaLight(1));
}

const std::string pointLight = "<emitter type=\"point\"><rgb name=\"intensity\" value=\"1000\"/>"
                               "<point name=\"position\" x=\"1.5\" y=\"0\" z=\"3\"/></emitter>";
const std::string sky = "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>";
/// Hides the lower half of the sky but for 3e-5 of the light of a tilted plane.
const std::string blackGround = "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"1000\"/>"
                                "<translate z=\"-0.01\"/></transform>" +
                                test::diffuse(0) + "</shape>";

struct DirectCase {
    const char* name;
    std::string body;
    double truth;
};

std::vector<DirectCase> directCases() {
    return {
        {"Point", pointLight + test::meterAt(0), 79.50463919999251},
        {"Square", test::squareLight(1, "z=\"1\"") + test::meterAt(0), 0.7522746884541075},
        {"SquareBesideUpright", test::squareLight(1, "x=\"1\" z=\"1\"") + test::meterAt(90), 0.22606333761415018},
        {"SquareCutByTheHorizon", test::squareLight(2, "z=\"1\"") + test::meterAt(90), 0.35018828771389676},
        {"Sphere", sphereLight(1, "x=\"0\" y=\"0\" z=\"2\"") + test::meterAt(0), 0.7853981633974483},
        {"SphereTilted", sphereLight(1, "x=\"0\" y=\"0\" z=\"2\"") + test::meterAt(45), 0.5553603672697958},
        {"SphereCutByTheHorizon", sphereLight(1, "x=\"0\" y=\"0\" z=\"2\"") + test::meterAt(90), 0.09058607370607957},
        {"SphereNear", sphereLight(1, "x=\"0\" y=\"0\" z=\"1.01\"") + test::meterAt(0, "y", 0.0002),
         pi / (1.01 * 1.01)},
        {"Sky", sky + test::meterAt(0), pi},
        {"SkyTilted", sky + blackGround + test::meterAt(60), pi * 0.75},
        {"BetweenParallelSquares", test::squareLight(1, "z=\"1\"") + test::meterAt(0, "y", 0.5),
         pi * 0.19982489569838746},
        {"OnThePerpendicularSquare", test::squareLight(1, "x=\"0.5\" z=\"0.5\"") + test::meterAt(90, "y", 0.5),
         pi * 0.20004377607540316},
    };
}

class Direct : public testing::TestWithParam<DirectCase> {};

TEST_P(Direct, IsTheClosedFormBySamplingEmitters) {
    expectReading(test::meterScene(GetParam().body), {"emitters"}, GetParam().truth, false, 8);
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, Direct, testing::ValuesIn(directCases()),
                         [](const auto& row) { return std::string(row.param.name); });

/// A disc as a fan of triangles, seen from `r` off its axis at the distance `h`, L = 1: Howell B-13 (parallel).
TEST(DirectDisc, IsTheClosedForm) {
    test::SceneFiles files;
    constexpr int corners = 720;
    constexpr double a = 0.5, h = 1, r = 1;
    std::string mesh = fmt::format("v {} 0 {}\n", r, h);
    // Of the circle's area: the polygon would have 1.3e-5 less.
    const double rim = a * std::sqrt(2 * pi / corners / std::sin(2 * pi / corners));
    for (int k = 0; k < corners; ++k)
        mesh += fmt::format("v {:.9f} {:.9f} {}\n", r + rim * std::cos(2 * pi * k / corners),
                            rim * std::sin(2 * pi * k / corners), h);
    for (int k = 0; k < corners; ++k) mesh += fmt::format("f 1 {} {}\n", 2 + (k + 1) % corners, 2 + k);
    files.write("disc.obj", mesh);
    const auto load = [&](double tilt) {
        return loadScene(files.write("scene.xml", "<scene version=\"3.0.0\"><shape type=\"obj\"><string "
                                                  "name=\"filename\" value=\"disc.obj\"/>" +
                                                      test::areaLight(1) + "</shape>" + test::meterAt(tilt) +
                                                      "</scene>"));
    };
    expectReading(load(0), {"parallel"}, 0.20696318838093658, false, 16);
    expectReading(load(90), {"perpendicular"}, 0.1827034225944803, false, 16);
    expectReading(load(30), {"tilted"}, 0.2705870900833556, false, 16);
}

/// Photons are counted where they arrive: larger meters, so that enough do.
TEST(DirectByPhotons, IsTheClosedForm) {
    const Method photons{"photons", 0, "auto", DirectLight::photons};
    const auto square = test::squareLight(1, "z=\"1\"") + test::meterAt(0, "y", 0.5);
    expectReading(test::meterScene(square), photons, pi * 0.19982489569838746, false, 32);
    const auto upright = test::squareLight(1, "x=\"0.5\" z=\"0.5\"") + test::meterAt(90, "y", 0.5);
    expectReading(test::meterScene(upright), photons, pi * 0.20004377607540316, false, 32);
    const Method camera{"camera map", 0, "auto", DirectLight::photons, Variant::main, MapOrder::camera};
    expectReading(test::meterScene(square), camera, pi * 0.19982489569838746, false, 32);
    // A sphere about a point light: all of its flux, 4 pi I / (4 pi r^2).
    const std::string within = "<emitter type=\"point\"><rgb name=\"intensity\" value=\"3\"/></emitter>"
                               "<shape type=\"sphere\"><float name=\"radius\" value=\"2\"/>"
                               "<boolean name=\"flip_normals\" value=\"true\"/>" +
                               test::diffuse(0) + test::irradiancemeter() + "</shape>";
    const Reading whole = measure(test::meterScene(within), photons, 4);
    EXPECT_NEAR(whole.value, 0.75, 1e-5);
}

// ---- the shape's own bsdf -------------------------------------------------------------------------------------------

TEST(Meter, ReadsTheSameWhateverTheShapeIsMadeOf) {
    const std::string mirror = "<bsdf type=\"conductor\"/>", null = "<bsdf type=\"null\"/>";
    for (const auto direct : {DirectLight::emitters, DirectLight::photons})
        for (const std::string& bsdf : {test::diffuse(0), test::diffuse(0.9), mirror, null}) {
            SCOPED_TRACE(bsdf);
            const auto scene = test::meterScene(test::squareLight(1, "z=\"1\"") + test::meterAt(0, "y", 0.5, bsdf));
            expectReading(scene, {"", 0, "auto", direct}, pi * 0.19982489569838746, false,
                          direct == DirectLight::emitters ? 8 : 32);
        }
}

TEST(Meter, ReadsOneSideOnly) {
    EXPECT_EQ(measure(test::meterScene(test::squareLight(1, "z=\"1\"") + test::meterAt(180)), {""}, 2).value, 0);
    const Method photons{"photons", 0, "auto", DirectLight::photons};
    EXPECT_EQ(
        measure(test::meterScene(test::squareLight(1, "z=\"1\"") + test::meterAt(180, "y", 0.5)), photons, 2).value, 0);
}

// ---- interreflection ------------------------------------------------------------------------------------------------

/// A closed box of emission 1 and reflectance 0.6, the meter on a wall or, with a null bsdf, in free space.
Scene furnace(bool onWall) {
    std::array<std::string, 6> parts;
    parts.fill(test::splitWall(0.6) + test::areaLight(1));
    if (onWall) parts[0] += test::irradiancemeter();
    const std::string within =
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.35\"/><rotate x=\"1\" angle=\"40\"/>"
        "</transform><bsdf type=\"null\"/>" +
        test::irradiancemeter() + "</shape>";
    return test::meterScene(test::unitRoom(parts) + (onWall ? "" : within));
}

constexpr double furnaceTruth = pi * 2.5;

class Furnace : public testing::TestWithParam<Method> {};

TEST_P(Furnace, IsPiTimesEmissionOverAbsorption) {
    const unsigned passes = GetParam().direct == DirectLight::photons ? 60 : 24; // what is counted is noisier
    expectReading(furnace(true), GetParam(), furnaceTruth, true, passes, 8000);
    expectReading(furnace(false), GetParam(), furnaceTruth, true, passes, 8000);
}

constexpr auto emitters = DirectLight::emitters;
constexpr auto photons = DirectLight::photons;
INSTANTIATE_TEST_SUITE_P(
    Methods, Furnace,
    testing::Values(Method{"StandardBdd0", 0, "none"}, Method{"StandardBdd1", 1, "none"},
                    Method{"StandardBdd2", 2, "none"}, Method{"StandardBdd0Photons", 0, "none", photons},
                    Method{"MainBdd0"}, Method{"MainBdd1", 1}, Method{"MainBdd2", 2},
                    Method{"MainBdd0Photons", 0, "auto", photons}, Method{"MainBdd1Photons", 1, "auto", photons},
                    Method{"AlternativeBdd0", 0, "auto", emitters, Variant::alternative},
                    Method{"AlternativeBdd1", 1, "auto", emitters, Variant::alternative},
                    Method{"MainBdd0CameraMap", 0, "auto", emitters, Variant::main, MapOrder::camera}),
    [](const auto& row) { return std::string(row.param.name); });

/// At the hits of a genuine diffuse meter's path d is at least 1, where F_qs takes no light: that is judged here too.
TEST(FurnaceControl, WrongReadingsOfTheLawShow) {
    for (const LawRule rule : {LawRule::quasiSpecularUntilFirst, LawRule::diffuseAtEveryHit, LawRule::fullAlongChain}) {
        const Method wrong{"", 1, "auto", emitters, Variant::main, MapOrder::photons, rule};
        const Reading reading = measure(furnace(true), wrong, 12, 8000);
        EXPECT_FALSE(agrees(reading, furnaceTruth, true)) << static_cast<int>(rule) << ": " << reading.value;
    }
}

/// Indirect E = flux rho / (A (1 - rho)), direct E = flux / A.
TEST(IntegratingSphere, HasTheClosedForm) {
    const std::string body =
        fmt::format("<emitter type=\"point\"><rgb name=\"intensity\" value=\"{}\"/></emitter>"
                    "<shape type=\"sphere\"><boolean name=\"flip_normals\" value=\"true\"/>{}{}</shape>",
                    1000 / (4 * pi), test::diffuse(0.8), test::irradiancemeter());
    const double truth = 318.30988618379075 + 1000 / (4 * pi);
    for (const unsigned bdd : {0u, 1u, 2u})
        for (const auto direct : {emitters, photons})
            expectReading(test::meterScene(body), {"", bdd, "auto", direct}, truth, true, 8);
}

TEST(CubeRadiosity, IsThatOfTheMatrix) {
    // Exitance pi of the face z1; reflectance 0.5: E = B / rho of the others, as B of z0 and x0.
    constexpr double ofFloor = 0.5378909483623088 / 0.5, ofSide = 0.5689696851585091 / 0.5;
    const auto room = [](size_t meter) {
        std::array<std::string, 6> parts;
        parts.fill(test::diffuse(0.5));
        parts[1] += test::areaLight(1);
        parts[meter] += test::irradiancemeter();
        return test::meterScene(test::unitRoom(parts));
    };
    for (const unsigned bdd : {0u, 1u, 2u}) {
        expectReading(room(0), {"", bdd}, ofFloor, true, 8);
        expectReading(room(2), {"", bdd}, ofSide, true, 8);
    }
    expectReading(room(0), {"", 0, "auto", photons}, ofFloor, true, 48);
}

// ---- films of more than a pixel, grids, radiance
//   ----------------------------------------------------------------------

/// The film's columns run along local x, its rows along local y, as the numbers do that Mitsuba draws points from.
TEST(Film, CoversTheRectangle) {
    const std::string body = pointLight +
                             "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"1\" "
                             "y=\"2\"/></transform>" +
                             test::diffuse(0) + test::irradiancemeter(2, 4) + "</shape>";
    const auto irradiance = [](double x, double y) {
        return 1000 * 3 / std::pow((x - 1.5) * (x - 1.5) + y * y + 9, 1.5);
    };
    for (const auto direct : {emitters, photons}) {
        RenderSettings settings;
        settings.direct = direct;
        settings.photonsPerPass = 20000;
        Renderer renderer(testDevice(), test::meterScene(body), settings);
        for (unsigned pass = 0; pass < 32; ++pass) renderer.renderPass(pass);
        const FilmImage image = renderer.develop();
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 2; ++i) {
                double truth = 0;
                for (int b = 0; b < 200; ++b) // to 1e-6
                    for (int a = 0; a < 200; ++a)
                        truth += irradiance(-1 + i + (a + 0.5) / 200, -2 + j + (b + 0.5) / 200) / 40000;
                const auto k = static_cast<size_t>(3 * (2 * j + i));
                EXPECT_NEAR(image.radiance[k], truth, 4 * image.standardError[k] + 1e-5 * truth) << i << ' ' << j;
            }
    }
}

TEST(Grid, ReadsItsPoints) {
    Scene scene = test::meterScene(
        pointLight +
        "<?quasilux illuminance-grid origin=\"-1,-1,0\" edge-u=\"2,0,0\" edge-v=\"0,2,0\" nx=\"4\" ny=\"2\"?>");
    ASSERT_EQ(scene.grids.size(), 1u);
    EXPECT_EQ(scene.sensor.meter, MeterKind::grid) << "a scene without a sensor measures its grid";
    RenderSettings settings;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 2; ++pass) renderer.renderPass(pass);
    const FilmImage image = renderer.develop();
    for (unsigned j = 0; j < 2; ++j)
        for (unsigned i = 0; i < 4; ++i) {
            const double x = -0.75 + 0.5 * i - 1.5, y = -0.5 + j;
            const double truth = 1000 * 3 / std::pow(x * x + y * y + 9, 1.5);
            EXPECT_NEAR(image.radiance[3 * (4 * j + i)], truth, 1e-5 * truth) << i << ' ' << j;
        }
}

/// Photons of distant light begin on a disc about the scene; points beyond its shapes are of it, too.
TEST(Grid, BeyondAllShapesHasDistantLight) {
    const std::string floor = "<shape type=\"rectangle\">" + test::diffuse(0) + "</shape>";
    const std::string sun = "<emitter type=\"directional\"><vector name=\"direction\" value=\"0,0,-1\"/>"
                            "<rgb name=\"irradiance\" value=\"2\"/></emitter>";
    const Scene scene = test::meterScene(floor + sun +
                                         "<?quasilux illuminance-grid origin=\"-3,-3,0.1\" edge-u=\"6,0,0\" "
                                         "edge-v=\"0,6,0\" nx=\"2\" ny=\"2\"?>");
    RenderSettings settings;
    settings.direct = photons;
    settings.photonsPerPass = 20000;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 16; ++pass) renderer.renderPass(pass);
    const FilmImage image = renderer.develop();
    for (size_t k = 0; k < 12; ++k) EXPECT_NEAR(image.radiance[k], 2, 4 * image.standardError[k] + 2e-5) << k;
}

TEST(Radiancemeter, ReadsTheRadianceOfARay) {
    const std::string sensor = "<sensor type=\"radiancemeter\"><point name=\"origin\" x=\"0.1\" y=\"0\" z=\"0.3\"/>"
                               "<vector name=\"direction\" x=\"1\" y=\"2\" z=\"-2\"/>" +
                               test::film(1, 1) + "</sensor>";
    std::array<std::string, 6> parts;
    parts.fill(test::splitWall(0.6) + test::areaLight(1));
    for (const auto map : {MapOrder::photons, MapOrder::camera})
        expectReading(test::meterScene(sensor + test::unitRoom(parts)), {"", 1, "auto", emitters, Variant::main, map},
                      2.5, true, 40, 8000);
}

// A meter of one pixel has all paths of a pass, and a lamp that lights little of a large scene much more irradiance than
// the scene has in the mean: the fixed-point sum of a pixel must hold both.
TEST(Meter, OnePixelHoldsTheSumOfAllPaths) {
    const Scene scene = test::meterScene(
        R"(<shape type="rectangle"><transform name="to_world"><scale value="50"/></transform>)" + test::diffuse(0) +
        R"(</shape><emitter type="spot"><transform name="to_world"><lookat origin="0,0,3" target="0,0,0" up="0,1,0"/></transform>
        <rgb name="intensity" value="1"/><float name="cutoff_angle" value="4"/><float name="beam_width" value="4"/></emitter>
        <shape type="cube"><transform name="to_world"><scale x="0.5" y="0.5" z="0.01"/><translate z="2"/></transform>
        <bsdf type="dielectric"><float name="int_ior" value="1.5"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.05"/><translate z="0.001"/></transform>)" +
        test::diffuse(0) + test::irradiancemeter() + "</shape>");
    RenderSettings settings; // as many paths of the pixel as photons, a power of two
    settings.photonsPerPass = 100'000;
    const auto reading = renderGroups(scene, settings, {0}, 10, 2).front();
    const double reflectance = 0.04, transmittance = (1 - reflectance) / (1 + reflectance); // of a pane, all orders
    const double expected = transmittance / std::pow(2.999 - 0.02 / 3, 2);
    EXPECT_NEAR(reading.mean, expected, 3 * reading.standardError + 0.002 * expected);
    EXPECT_LT(reading.standardError, 0.01 * expected);
}

} // namespace
} // namespace quasilux
