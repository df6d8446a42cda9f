// Spots: falloff and texture (values of Mitsuba 3.9.1), photons, light through openings, and reading; and emitters that
// the camera does not see. False-alarm rate of the tests of samplers 1e-4 together; renders are held to 4 standard
// errors of 10 batches (Student t: 0.3 % each). Seeds are fixed.
#include "prepare/device_scene.h"
#include "support/chi_squared.h"
#include "support/emitter_cases.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/textured_emitters.h"
#include "support/wrong_learning.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int statisticalTests = 10;
constexpr size_t sampleCount = 100000;
constexpr double degree = pi / 180;
const dvec3 place(1, -2, 3), axis = glm::normalize(dvec3(0.3, -0.5, 0.8));

struct Cone {
    double beam, cutoff; // radians
};
constexpr Cone cones[] = {{15 * degree, 20 * degree}, {0, 60 * degree}, {10 * degree, 100 * degree}, {0.01, 0.0100001}};

dvec3 directionAt(double angle, double azimuth) {
    const dvec3 s = glm::normalize(glm::cross(axis, dvec3(1, 0, 0))), t = glm::cross(axis, s);
    return std::cos(angle) * axis + std::sin(angle) * (std::cos(azimuth) * s + std::sin(azimuth) * t);
}

double shareAt(const Cone& cone, double angle) {
    return std::clamp((cone.cutoff - angle) / (cone.cutoff - cone.beam), 0.0, 1.0);
}

TEST(SpotEmitter, FallsOffAsInMitsuba) {
    // sample_direction of mitsuba 3.9.1, scalar_rgb, times distance squared: cutoff_angle 20 (beam_width 15), then 100
    // and 10.
    const std::pair<Cone, std::vector<std::pair<double, double>>> expected[] = {
        {cones[0], {{0, 1}, {10, 1}, {14.9, 1}, {15.1, 0.98}, {16, 0.8}, {18, 0.4}, {19.9, 0.02}, {20.1, 0}}},
        {cones[2], {{0, 1}, {9, 1}, {50, 0.5555556}, {95, 0.05555554}, {101, 0}}}};
    for (const auto& [cone, values] : expected)
        for (const auto& [degrees, value] : values) {
            const dvec3 from = place + 2.0 * directionAt(degrees * degree, 0.7);
            const auto s =
                sampleDirections({makeSpot(place, axis, cone.beam, cone.cutoff)}, {}, from, {0.3f, 0.1f, 0.9f})[0];
            EXPECT_EQ(s.valid, value > 0) << degrees;
            EXPECT_NEAR(s.valid ? s.radianceOverPdf.x * 4 : 0, value, 3e-5) << degrees;
            EXPECT_NEAR(s.valid ? s.distance : 2, 2, 1e-5);
            EXPECT_EQ(s.pdf, 0);
        }
}

TEST(SpotEmitter, PhotonsAreEvenInTheConeAndCarryTheIntensity) {
    for (const Cone& cone : cones) {
        const SampleGrid grid{0, 1, -pi, pi, 12, 12};
        std::vector<uint64_t> counts(grid.cells() + 1);
        const auto spot = makeSpot(place, axis, cone.beam, cone.cutoff);
        const double solidAngle = 4 * pi * std::pow(std::sin(spot.cutoffAngle / 2), 2);
        double sum = 0, squares = 0;
        const dvec3 s = directionAt(pi / 2, 0), t = directionAt(pi / 2, pi / 2);
        for (const auto& p : samplePhotons({spot}, {}, uniformNumbers(5 * sampleCount, 31))) {
            const dvec3 off = p.direction - wide(spot.normal);
            const double share = 0.25 * glm::dot(off, off) / std::pow(std::sin(spot.cutoffAngle / 2), 2);
            ++counts[grid.cell(share < 1.01 ? std::min(share, 1.0) : share,
                               std::atan2(glm::dot(p.direction, t), glm::dot(p.direction, s)))];
            ASSERT_LT(glm::length(p.position - place), 1e-6);
            const double angle = 2 * std::asin(std::min(1.0, glm::length(off) / 2));
            if (cone.cutoff - cone.beam > 0.01) {
                ASSERT_NEAR(p.flux.x / solidAngle, shareAt(cone, angle), 1e-4);
            }
            sum += p.flux.x;
            squares += p.flux.x * p.flux.x;
        }
        EXPECT_GT(chiSquaredPValue(counts, std::vector<double>(grid.cells(), 1.0 / grid.cells())),
                  significanceLevel(statisticalTests));
        const double b = cone.beam, c = cone.cutoff, power = 2 * pi * (1 - (std::sin(c) - std::sin(b)) / (c - b));
        const double mean = sum / sampleCount,
                     error = std::sqrt(std::max(squares / sampleCount - mean * mean, 0.0) / sampleCount) + 2e-5 * power;
        EXPECT_GT(normalPValue((mean - power) / error), significanceLevel(statisticalTests));
        EXPECT_LT(normalPValue((mean - 1.05 * power) / error), significanceLevel(statisticalTests))
            << "negative control";
    }
}

TEST(SpotEmitter, InversionGivesTheNumbersOfAPhoton) {
    for (const Cone& cone : cones) {
        const auto spot = makeSpot(place, axis, cone.beam, cone.cutoff);
        const auto numbers = uniformNumbers(5 * 3000, 32), inverted = invertedNumbers(spot, numbers);
        for (size_t i = 0; i < numbers.size(); i += 5) {
            ASSERT_NEAR(inverted[i + 3], numbers[i + 3], 5e-3) << cone.cutoff;
            const double turn = std::abs(inverted[i + 4] - numbers[i + 4]);
            if (numbers[i + 3] > 0.01) {
                ASSERT_LT(std::min(turn, 1 - turn), 5e-3) << cone.cutoff;
            }
        }
    }
}

// --- its texture ---

/// The picture of writeSixPixels, repeated, in a spot that is placed askew.
TexturedEmitter spotWithPicture(double cutoff) {
    test::SceneFiles files;
    writeSixPixels(files.path("six.exr"));
    return lastEmitter(loadScene(files.write(
        "scene.xml",
        test::sceneWith(
            R"(<shape type="rectangle"/><emitter type="spot"><float name="beam_width" value="10"/><float name="cutoff_angle" value=")" +
            std::to_string(cutoff) +
            R"("/><texture type="bitmap" name="texture"><string name="filename" value="six.exr"/>
        <transform name="to_uv"><scale x="1.5" y="2"/></transform></texture><transform name="to_world"><lookat origin="1,-2,3"
        target="2,0,4" up="0,0,1"/></transform></emitter>)"))));
}

TEST(SpotTexture, IsLookedUpAsInMitsuba) {
    // sample_direction of mitsuba 3.9.1, scalar_rgb, times distance squared.
    const std::vector<dvec3> local{{0, 0, 1}, {0.2, 0.1, 1}, {-0.3, 0.2, 1}, {0.1, -0.4, 1}, {-0.1, -0.2, 1}};
    const std::pair<double, std::vector<dvec3>> expected[] = {{30,
                                                               {{0.325, 1.625001, 1.025},
                                                                {0.121937, 0.609684, 1.373754},
                                                                {0.058969, 0.294845, 0.84039},
                                                                {0.078348, 0.391740, 0.524269},
                                                                {0.328936, 1.644679, 0.752754}}},
                                                              {100,
                                                               {{0.325, 1.625, 1.025},
                                                                {0.318164, 1.590819, 0.987634},
                                                                {0.318965, 1.594824, 0.824727},
                                                                {0.240292, 1.201461, 1.003415},
                                                                {0.298901, 1.494504, 1.045422}}}};
    std::vector<dvec3> directions;
    for (const dvec3& d : local) directions.push_back(askew(d));
    for (const auto& [cutoff, values] : expected) {
        const auto found = intensities(spotWithPicture(cutoff), directions);
        for (size_t k = 0; k < values.size(); ++k) EXPECT_LT(glm::length(found[k] - values[k]), 2e-5) << cutoff << k;
    }
}

TEST(SpotTexture, PhotonsCarryTheIntensityAndThePowerIsTheirMean) {
    for (const double cutoff : {30.0, 100.0}) {
        const TexturedEmitter emitter = spotWithPicture(cutoff);
        const auto numbers = uniformNumbers(2 * sampleCount, 33);
        const auto photons = directedPhotons(emitter, numbers);
        std::vector<dvec3> directions;
        for (const auto& p : photons) directions.push_back(p.direction);
        const auto expected = intensities(emitter, directions);
        const double solidAngle = 4 * pi * std::pow(std::sin(cutoff * degree / 2), 2);
        double sum = 0, squares = 0;
        for (size_t i = 0; i < photons.size(); ++i) {
            // Across the axis the picture runs to infinity.
            if (std::abs(glm::dot(photons[i].direction, askew({0, 0, 1}))) > 0.2) {
                ASSERT_LT(glm::length(photons[i].flux / solidAngle - expected[i]), 2e-4) << cutoff;
            }
            ASSERT_NEAR(photons[i].found.x, numbers[2 * i], 1e-4);
            const double flux = (photons[i].flux.x + photons[i].flux.y + photons[i].flux.z) / 3;
            sum += flux;
            squares += flux * flux;
        }
        const double mean = sum / sampleCount, error = std::sqrt((squares / sampleCount - mean * mean) / sampleCount);
        // The sums of the power take middles of cells: 0.05 % of it.
        const double both = std::hypot(error, 5e-4 * emitter.power);
        EXPECT_GT(normalPValue((mean - emitter.power) / both), significanceLevel(statisticalTests));
        EXPECT_LT(normalPValue((mean - 1.05 * emitter.power) / both), significanceLevel(statisticalTests))
            << "negative control";
    }
}

// --- renders ---

/// A floor of albedo 0.5 under a spot at height 2 that looks down; the picture covers [-1, 1]^2 of it.
Scene floorUnderSpot(const std::string& integrator = "", const std::string& more = "",
                     const std::string& texture = "") {
    test::SceneFiles files;
    writeFloats(files.path("halves.exr"), 2, 1, {2, 2, 2, 0.25f, 0.25f, 0.25f});
    return loadScene(
        files.write("scene.xml", R"(<scene version="3.0.0"><integrator type="path">)" + integrator +
                                     R"(</integrator><sensor type="orthographic"><transform name="to_world">
        <rotate y="1" angle="180"/><translate z="5"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
        <emitter type="spot"><float name="cutoff_angle" value="25"/><float name="beam_width" value="10"/>
        <float name="intensity" value="8"/><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/></transform>)" +
                                     texture + R"(
        </emitter><shape type="rectangle"><transform name="to_world"><scale value="4"/></transform><bsdf type="diffuse"/></shape>)" +
                                     more + "</scene>"));
}

/// Mean over the picture of albedo / pi times intensity cos^3 / height^2.
double floorRadiance() {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double x = 2 * (i + 0.5) / n - 1, y = 2 * (j + 0.5) / n - 1,
                         cosine = 2 / std::sqrt(x * x + y * y + 4);
            sum += 8 * shareAt({10 * degree, 25 * degree}, std::acos(cosine)) * std::pow(cosine, 3) / 4;
        }
    return 0.5 / pi * sum / (n * n);
}

TEST(SpotRender, FloorIsLitByTheLawWhateverWasLearned) { expectMeanOfImage(floorUnderSpot(), floorRadiance()); }

TEST(SpotRender, FloorUnderAPictureHasTheMeanOfItsHalves) {
    expectMeanOfImage(
        floorUnderSpot("", "",
                       R"(<texture type="bitmap" name="texture"><string name="filename" value="halves.exr"/>
        <string name="filter_type" value="nearest"/></texture>)"),
        1.125 * floorRadiance());
}

TEST(HiddenEmitters, CameraLooksThroughThemAndSeesNoSky) {
    // A lamp above the spot, which shines upwards and shades nothing, and a sky of which the floor's light is known
    // too.
    const std::string lamp =
        R"(<shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="3"/></transform>
        <emitter type="area"><rgb name="radiance" value="100"/></emitter></shape>)";
    const std::string hide = R"(<boolean name="hide_emitters" value="true"/>)";
    const double truth = floorRadiance();
    for (const char* kind : {"emitters", "photons"}) {
        const DirectLight direct = kind[0] == 'e' ? DirectLight::emitters : DirectLight::photons;
        const auto hidden = meanOfImage(floorUnderSpot(hide, lamp), direct, false);
        EXPECT_NEAR(hidden.mean, truth, 4 * hidden.standardError + 0.005 * truth) << kind;
    }
    EXPECT_GT(meanOfImage(floorUnderSpot("", lamp), DirectLight::emitters, false).mean, 90) << "control: it is seen";
    // One that is off is hidden too, as in Mitsuba.
    std::string off = lamp;
    off.replace(off.find("100"), 3, "0");
    const auto hidden = meanOfImage(floorUnderSpot(hide, off), DirectLight::emitters, false);
    EXPECT_NEAR(hidden.mean, truth, 4 * hidden.standardError + 0.005 * truth);
    EXPECT_EQ(meanOfImage(floorUnderSpot("", off), DirectLight::emitters, false).mean, 0) << "control: a black plate";
    // Nothing but sky in the picture.
    const auto sky = [](const std::string& integrator) {
        test::SceneFiles files;
        return loadScene(
            files.write("scene.xml", R"(<scene version="3.0.0"><integrator type="path">)" + integrator +
                                         R"(</integrator><sensor type="perspective"><float name="fov" value="10"/>
            <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film>
            </sensor><emitter type="constant"/><shape type="cube"><transform name="to_world"><translate z="-9"/></transform>
            </shape></scene>)"));
    };
    EXPECT_EQ(meanOfImage(sky(hide), DirectLight::emitters, false).mean, 0);
    EXPECT_NEAR(meanOfImage(sky(""), DirectLight::emitters, false).mean, 1, 1e-6) << "control";
}

// --- reading ---

std::string spot(const std::string& parameters) { return "<emitter type=\"spot\">\n" + parameters + "</emitter>"; }

TEST(SpotReader, ReadsWhatIsGivenAndDefaults) {
    const Scene scene = test::loadBody(
        spot("<rgb name=\"intensity\" value=\"1,2,3\"/><float name=\"cutoff_angle\" value=\"40\"/><transform "
             "name=\"to_world\"><lookat origin=\"1,2,3\" target=\"1,2,7\" up=\"0,1,0\"/></transform>") +
        spot("") + spot("<float name=\"beam_width\" value=\"30\"/>"));
    ASSERT_EQ(scene.pointEmitters.size(), 4u);
    const auto& first = scene.pointEmitters[1];
    ASSERT_TRUE(first.spot);
    test::expectNear(first.position, {1, 2, 3});
    test::expectNear(first.spot->axis, {0, 0, 1});
    EXPECT_EQ(first.intensity.b, 3);
    EXPECT_NEAR(first.spot->cutoffAngle, 40 * degree, 1e-12);
    EXPECT_NEAR(first.spot->beamAngle, 30 * degree, 1e-12);
    EXPECT_NEAR(scene.pointEmitters[2].spot->cutoffAngle, 20 * degree, 1e-12);
    EXPECT_NEAR(scene.pointEmitters[2].spot->beamAngle, 15 * degree, 1e-12);
    EXPECT_NEAR(scene.pointEmitters[3].spot->beamAngle, 20 * degree, 1e-6) << "full up to the cutoff";
    EXPECT_LT(scene.pointEmitters[3].spot->beamAngle, scene.pointEmitters[3].spot->cutoffAngle);
}

TEST(SpotReader, TakesATextureOrAColourForIt) {
    const Scene scene =
        test::loadBody(spot("<texture type=\"checkerboard\" name=\"texture\"/><transform name=\"to_world\"><scale "
                            "value=\"3\"/></transform>") +
                       spot("<rgb name=\"intensity\" value=\"1,2,3\"/><rgb name=\"texture\" value=\"2,1,0.5\"/>"));
    const auto& first = scene.pointEmitters.at(1);
    ASSERT_TRUE(first.picture);
    EXPECT_EQ(scene.textures.at(first.picture->texture.value()).device.type, TEXTURE_CHECKERBOARD);
    const auto edge = float(0.5 / std::tan(20 * degree));
    test::expectNear(first.picture->u, {edge, 0, 0});
    test::expectNear(first.picture->v, {0, edge, 0});
    const auto& second = scene.pointEmitters.at(2);
    EXPECT_FALSE(second.picture);
    EXPECT_EQ(second.intensity.r, 2);
    EXPECT_EQ(second.intensity.b, 1.5f);
}

TEST(SpotReader, SaysWhatIsWrong) {
    test::SceneFiles files;
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {spot("<float name=\"cutoff_angle\" value=\"0\"/>"), {"scene.xml:5:1", "cutoff_angle"}},
        {spot("<float name=\"cutoff_angle\" value=\"181\"/>"), {"scene.xml:5:1", "at most 180"}},
        {spot("<float name=\"beam_width\" value=\"-1\"/>"), {"scene.xml:5:1", "beam_width"}},
        {spot("<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
         {"scene.xml:5:1", "scales directions differently"}},
        {spot("<texture type=\"mesh_attribute\" name=\"texture\"><string name=\"name\" "
              "value=\"vertex_color\"/></texture>"),
         {"scene.xml:5:1", "the texture 'texture' of emitter 'spot' gives what is emitted from one point",
          "use a 'bitmap'"}},
        {spot("<texture type=\"checkerboard\" name=\"texture\"><texture type=\"volume\" "
              "name=\"color0\"/></texture>"),
         {"scene.xml:5:1", "gives what is emitted from one point"}},
        {spot("<texture type=\"bitmap\" name=\"texture\"/>"), {"scene.xml:5:1", "needs <string name=\"filename\""}},
        {spot("<float name=\"cutof_angle\" value=\"1\"/>"), {"scene.xml:5:1", "Did you mean 'cutoff_angle'"}}};
    test::expectErrors(files, cases);
}

} // namespace
} // namespace quasilux
