// UGR against rooms computed by hand, and Guth's position index against his table. docs/method/glare.md has the same
// room.
#include "photometry/glare.h"
#include "scene/observer.h"
#include "support/eye_readings.h"
#include "support/gltf_files.h"
#include "support/luminaire_files.h"
#include "support/meter_scenes.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::SizeIs;

const LineOfSight ahead{{0, 1, 0}, {0, 0, 1}};

/// Of what lies `right` and `above` the line of sight, at depth 1.
double indexAt(double right, double above) { return positionIndex(ahead, glm::normalize(glm::dvec3(right, 1, above))); }

TEST(PositionIndex, IsThatOfGuthsTable) {
    EXPECT_EQ(indexAt(0, 0), 1);
    // Straight above, by H / R: CIE 117:1995, table of position indices, the column T / R = 0.
    const std::pair<double, double> table[] = {{0.1, 1.26},  {0.2, 1.53}, {0.3, 1.90},  {0.4, 2.35},  {0.5, 2.86},
                                               {0.6, 3.50},  {0.7, 4.20}, {0.8, 5.00},  {0.9, 6.00},  {1.0, 7.00},
                                               {1.1, 8.10},  {1.2, 9.25}, {1.3, 10.35}, {1.4, 11.70}, {1.5, 13.15},
                                               {1.6, 14.70}, {1.7, 16.20}};
    for (const auto& [height, index] : table) EXPECT_NEAR(indexAt(0, height), index, 0.05 * index) << height;
    EXPECT_NEAR(indexAt(1, 0), 2.11, 0.05 * 2.11) << "beside";
    EXPECT_EQ(indexAt(0.3, 0.4), indexAt(-0.3, 0.4));
    EXPECT_EQ(indexAt(0.3, 0.4), indexAt(0.3, -0.4));
    EXPECT_TRUE(std::isinf(positionIndex(ahead, {0, -1, 0})));
    EXPECT_NEAR(positionIndexOfDaylight(ahead, glm::normalize(glm::dvec3(0.3, 1, -0.4))), 1.4, 1e-12);
    EXPECT_NEAR(positionIndexOfDaylight(ahead, glm::normalize(glm::dvec3(0.6, 1, -0.8))), 2.2, 1e-12);
    EXPECT_EQ(positionIndexOfDaylight(ahead, glm::normalize(glm::dvec3(0.3, 1, 0.4))), indexAt(0.3, 0.4));
    // Bounds of evalglare.
    EXPECT_GT(indexAt(0, 3), 16);
    EXPECT_EQ(positionIndexOfDaylight(ahead, glm::normalize(glm::dvec3(0, 1, 3))), 16);
    EXPECT_NEAR(positionIndexOfDaylight(ahead, glm::normalize(glm::dvec3(0, 1, -7))), 1 + 1.2 * 3, 1e-12);
}

TEST(Glare, RatingIsTheFormulaOfTheCie) {
    const GlareRating rating = unifiedGlareRating(7783, 4, 0.04);
    EXPECT_NEAR(rating.value, 8 * std::log10(0.25 * pi / 4 * 7783), 1e-12);
    EXPECT_NEAR(rating.standardError, 8 / std::log(10) * 0.01, 1e-12);
    EXPECT_TRUE(std::isnan(unifiedGlareRating(7783, 0, 0).value)) << "a black room has no background";
    // Slope of the value itself.
    EXPECT_NEAR(unifiedGlareRating(7783, 4, 0).value - unifiedGlareRating(7783, 4.04, 0).value, rating.standardError,
                1e-3);
}

/// Shines 100 cd everywhere from a ball of 0.2 m.
std::string ball(const test::SceneFiles& files, const std::string& place) {
    test::IesText ies;
    ies.vertical = {0, 90, 180};
    ies.size = "-0.2 -0.2 -0.2";
    files.write("ball.ies", ies.text());
    return "<emitter type=\"quasilux_ies\" id=\"ball\"><string name=\"filename\" value=\"ball.ies\"/>"
           "<transform name=\"to_world\"><translate value=\"" +
           place + "\"/></transform></emitter>\n";
}

/// A panel of 0.6 m at z = 1 above y = `y` that faces down with 2000 cd/m², as a luminaire of a file.
std::string panel(const test::SceneFiles& files, double y, const std::string& size = "0.6 0.6 0") {
    test::IesText ies;
    for (double angle = 0; angle <= 90; ++angle) ies.vertical.push_back(angle);
    ies.vertical.erase(ies.vertical.begin(), ies.vertical.begin() + 3);
    ies.size = size;
    ies.candela = [](double v, double) { return 720 * std::cos(v * pi / 180); };
    files.write("panel.ies", ies.text());
    return fmt::format("<emitter type=\"quasilux_ies\"><string name=\"filename\" value=\"panel.ies\"/>"
                       "<transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/><translate y=\"{}\" z=\"1\"/>"
                       "</transform></emitter>\n",
                       y);
}

/// The same panel as a shape.
std::string panelShape(double y) {
    return fmt::format("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.3\"/><rotate x=\"1\" "
                       "angle=\"180\"/><translate y=\"{}\" z=\"1\"/></transform>{}</shape>\n",
                       y, test::areaLight(2000 / 683.0));
}

const std::string eyeAtOrigin = "<?quasilux observer position=\"0,0,0\" direction=\"0,1,0\"?>";

Scene sceneOf(const test::SceneFiles& files, const std::string& body) {
    return loadScene(
        files.write("scene.xml", std::string("<scene version=\"3.0.0\">") + test::minimalSensor + body + "</scene>"));
}

GlareSources sourcesOf(const Scene& scene) { return test::sourcesSeenBy(scene, scene.observers.at(0)); }

// A `null` surface hides no lamp, so what passes it is direct light; a pane hides it here. By any integrator.
TEST(Glare, DirectLightIsThatOfTheSourcesThatAreSeen) {
    const test::SceneFiles files;
    for (const std::string integrator : {"path", "volpath"}) {
        const auto direct = [&](const std::string& bsdf) {
            const Scene scene = sceneOf(files, fmt::format(R"(<integrator type="{}"/>{}<shape type="sphere"><point
                name="center" x="0" y="-2" z="-1"/><float name="radius" value="0.5"/><bsdf type="{}"/></shape>
                <?quasilux observer position="0,-2,-1" direction="0,1,0"?>)",
                                                           integrator, ball(files, "0,0,0"), bsdf));
            const Observer& observer = scene.observers.at(0);
            EXPECT_EQ(sourcesOf(scene).seen.size(), bsdf == "null" ? 1u : 0u);
            const auto first = [](const auto& points) { return points.front(); };
            return test::readingsAtEye(scene, observer, EyeLight::direct, 4).figure(first).value;
        };
        EXPECT_NEAR(direct("null"), 100 / 5.0 * 2 / std::sqrt(5), 0.05) << integrator;
        EXPECT_EQ(direct("thindielectric"), 0) << integrator;
    }
}

// In a white ball with reflectance 1/2 all walls have the same luminance where the luminaire shines alike in all
// directions from the centre: E = I / r² = 4 lx by direct light, 8 lx with all reflections, so L = 4 / pi cd/m², and at
// every place and in every direction Ei = 4 lx and Lb = 4 / pi. The eye at (0, -2, -1) looks along +y: the source is at
// 5 m² and straight above, with tan sigma = 1/2.
TEST(Glare, OfARoomComputedByHand) {
    const test::SceneFiles files;
    const Scene scene = sceneOf(files, ball(files, "0,0,0") +
                                           "<shape type=\"sphere\"><float name=\"radius\" value=\"5\"/><boolean "
                                           "name=\"flip_normals\" value=\"true\"/>" +
                                           test::diffuse(0.5) +
                                           "</shape><?quasilux observer position=\"0,-2,-1\" direction=\"0,1,0\"?>");
    const Observer observer = scene.observers.at(0);
    const GlareSources sources = sourcesOf(scene);
    ASSERT_THAT(sources.seen, SizeIs(1));
    const GlareSource& source = sources.seen[0];
    const double area = pi * 0.01, sigma = std::atan(0.5) * 180 / pi,
                 p = std::exp((35.2 - 1.22) * 1e-3 * sigma + 21e-5 * sigma * sigma);
    EXPECT_NEAR(source.luminance, 100 / area, 1);
    EXPECT_NEAR(source.solidAngle, area / 5, 1e-6);
    EXPECT_NEAR(source.positionIndex, p, 0.02);
    EXPECT_EQ(source.visible, 1);

    const ObserverFigures figures = test::figuresOf(scene, observer, 32);
    // Four standard errors: 1 in 16,000 by chance; and 0.5 % for the radius of the density estimate.
    EXPECT_NEAR(figures.indirect.value, 4, 4 * figures.indirect.standardError + 0.02);
    EXPECT_NEAR(figures.direct.value, 100 / 5.0 * 2 / std::sqrt(5), 0.05);
    const double strength = std::pow(100 / area / p, 2) * area / 5;
    const auto rated = [&](double byStrength, double background) {
        return 8 * std::log10(0.25 / background * byStrength);
    };
    const double tolerance = 4 * figures.rating.standardError + 0.05;
    EXPECT_LT(figures.rating.standardError, 0.1) << "too noisy to decide anything";
    EXPECT_NEAR(figures.rating.value, rated(strength, 4 / pi), tolerance);
    EXPECT_LT(figures.rating.halfWidth(), 0.2);
    // Wrong rules: without the position index; with the direct light in the background.
    EXPECT_GT(std::abs(figures.rating.value - rated(strength * p * p, 4 / pi)), tolerance);
    EXPECT_GT(std::abs(figures.rating.value - rated(strength, (4 + 17.889) / pi)), tolerance);
}

TEST(Glare, ASurfaceIsRatedAsTheFileOfIt) {
    const test::SceneFiles files;
    const GlareSources file = sourcesOf(sceneOf(files, panel(files, 2) + eyeAtOrigin)),
                       shape = sourcesOf(sceneOf(files, panelShape(2) + eyeAtOrigin));
    ASSERT_THAT(file.seen, SizeIs(1));
    ASSERT_THAT(shape.seen, SizeIs(1));
    EXPECT_NEAR(file.seen[0].luminance, 2000, 2);
    EXPECT_NEAR(shape.seen[0].luminance, 2000, 2);
    // Of the file the solid angle is area / distance², of the shape the exact one.
    EXPECT_NEAR(file.seen[0].solidAngle, 0.36 / std::sqrt(5) / 5, 1e-6);
    EXPECT_NEAR(shape.seen[0].solidAngle, file.seen[0].solidAngle, 0.02 * file.seen[0].solidAngle);
    EXPECT_NEAR(shape.seen[0].positionIndex, file.seen[0].positionIndex, 0.05);
    // Two of them are twice as strong; behind the eye there is none, and from above it does not shine.
    const GlareSources both =
        sourcesOf(sceneOf(files, panel(files, 2) + panel(files, 2) + panel(files, -2) + panelShape(-2) + eyeAtOrigin));
    EXPECT_NEAR(both.strength(), 2 * file.strength(), 1e-6 * file.strength());
    EXPECT_TRUE(
        sourcesOf(sceneOf(files, panelShape(2) + "<?quasilux observer position=\"0,0,2\" direction=\"0,1,0\"?>"))
            .seen.empty());
}

// Of a glTF file +y is up: a small square 2 m ahead and 1 m above has the index of the angle above the line of sight.
TEST(Glare, OfAGltfFileHasItsUpright) {
    const test::SceneFiles files;
    test::GltfFile file;
    file.add("materials", {{"emissiveFactor", {1, 1, 1}}});
    const double half = std::sqrt(0.5); // a quarter turn, towards -x
    file.addNode({{"mesh", file.addSquare({{"material", 0}})},
                  {"rotation", {0, -half, 0, half}},
                  {"scale", {0.01, 0.01, 1}},
                  {"translation", {2, 1, 0}}});
    file.json["scenes"][0]["extras"]["quasilux"]["observer"] = {{"position", {0, 0, 0}}, {"direction", {1, 0, 0}}};
    const GlareSources sources = sourcesOf(loadScene(files.write("scene.glb", file.binary())));
    ASSERT_THAT(sources.seen, SizeIs(1));
    const double sigma = std::atan(0.5) * 180 / pi;
    EXPECT_NEAR(sources.seen[0].positionIndex, std::exp((35.2 - 1.22) * 1e-3 * sigma + 21e-5 * sigma * sigma), 0.01);
}

// A sphere whose normals are flipped shines inwards alone.
TEST(Glare, ASphereShinesOnTheSideOfItsNormal) {
    const test::SceneFiles files;
    const auto sourcesBy = [&](double distance, bool inwards) {
        return sourcesOf(sceneOf(files, fmt::format("<shape type=\"sphere\" id=\"lamp\"><point name=\"center\" "
                                                    "value=\"0,{},0\"/><float name=\"radius\" value=\"0.5\"/>"
                                                    "<boolean name=\"flip_normals\" value=\"{}\"/>{}</shape>",
                                                    distance, inwards, test::areaLight(1)) +
                                            eyeAtOrigin));
    };
    const GlareSources outwards = sourcesBy(2, false);
    ASSERT_THAT(outwards.seen, SizeIs(1));
    EXPECT_NEAR(outwards.seen[0].solidAngle / outwards.seen[0].visible, 2 * pi * (1 - std::sqrt(15.0 / 16)), 1e-6);
    EXPECT_TRUE(sourcesBy(2, true).seen.empty()) << "dark from outside";
    EXPECT_TRUE(sourcesBy(2, true).leftOut.empty());
    EXPECT_TRUE(sourcesBy(0.25, false).seen.empty()) << "dark from inside";
    EXPECT_TRUE(sourcesBy(0.25, false).leftOut.empty());
    const GlareSources around = sourcesBy(0.25, true);
    EXPECT_TRUE(around.seen.empty());
    ASSERT_THAT(around.leftOut, SizeIs(1)) << "it has no position";
    EXPECT_THAT(around.leftOut[0], HasSubstr("'lamp' surrounds the eye"));
}

TEST(Glare, WhatIsHiddenDoesNotGlare) {
    const test::SceneFiles files;
    const auto wall = [](double x) { // beyond x
        return test::rectangle("1,1,1", "<rotate x=\"1\" angle=\"90\"/>", fmt::format("{},1,0.5", x + 1),
                               test::diffuse(0));
    };
    for (const bool asShape : {false, true}) {
        const std::string lamp = asShape ? panelShape(2) : panel(files, 2);
        const double whole = sourcesOf(sceneOf(files, lamp + eyeAtOrigin)).strength();
        // Half of it stands behind the edge of a wall half way.
        const GlareSources half = sourcesOf(sceneOf(files, lamp + wall(0) + eyeAtOrigin));
        ASSERT_THAT(half.seen, SizeIs(1));
        EXPECT_NEAR(half.seen[0].visible, 0.5, 0.05) << asShape;
        EXPECT_NEAR(half.strength(), whole / 2, 0.1 * whole / 2) << asShape;
        EXPECT_TRUE(sourcesOf(sceneOf(files, lamp + wall(-1) + eyeAtOrigin)).seen.empty());
    }
}

TEST(Glare, WhatHasNoLuminanceIsSaid) {
    const test::SceneFiles files;
    const GlareSources sources = sourcesOf(sceneOf(files, test::minimalLight + panel(files, 2) + eyeAtOrigin));
    EXPECT_THAT(sources.seen, SizeIs(1));
    ASSERT_THAT(sources.leftOut, SizeIs(1));
    EXPECT_THAT(sources.leftOut[0], HasSubstr("is a point"));
    const GlareSources line = sourcesOf(sceneOf(files, panel(files, 2, "0 1.2 0") + eyeAtOrigin));
    EXPECT_THAT(line.seen, SizeIs(0));
    ASSERT_THAT(line.leftOut, SizeIs(1));
    EXPECT_THAT(line.leftOut[0], HasSubstr("no luminous area"));
}

TEST(Observer, IsReadOrRefused) {
    const test::SceneFiles files;
    const Scene scene = sceneOf(files, std::string(test::minimalLight) + eyeAtOrigin +
                                           "<?quasilux observer name=\"desk\" position=\"1,2,3\" direction=\"2,0,0\" "
                                           "up=\"0,5,0\" size=\"0.2\"?>");
    ASSERT_THAT(scene.observers, SizeIs(2));
    EXPECT_EQ(scene.observers[0].name, "observer 1");
    EXPECT_EQ(scene.observers[1].name, "desk");
    EXPECT_EQ(scene.observers[1].direction, glm::dvec3(1, 0, 0));
    const IlluminanceGrid grid = eyeGrid(scene.observers[1]);
    EXPECT_NEAR(glm::length(grid.point(0, 0) - glm::dvec3(1, 2, 3)), 0, 1e-12);
    EXPECT_NEAR(glm::length(grid.normal() - glm::dvec3(1, 0, 0)), 0, 1e-12) << "light from where the eye looks";
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"<?quasilux observer position=\"0,0,0\"?>", {"the observer lacks direction"}},
        {"<?quasilux observer position=\"0,0,0\" direction=\"0,0,0\"?>", {"direction is 0,0,0"}},
        {"<?quasilux observer position=\"0,0,0\" direction=\"0,0,1\"?>", {"direction and up are parallel"}},
        {"<?quasilux observer position=\"0,0\" direction=\"0,0,1\"?>", {"position has 2 numbers"}},
        {"<?quasilux observer position=\"0,0,0\" direction=\"0,1,0\" size=\"0\"?>", {"expected a number above 0"}},
        {"<?quasilux observer position=\"0,0,0\" direction=\"0,1,0\" age=\"40\"?>",
         {"unknown key 'age' of an observer"}},
        {"<?quasilux obsever position=\"0,0,0\"?>", {"unknown <?quasilux obsever", "'observer'"}},
    };
    test::expectErrors(files, cases);
}

// Of independent normal readings the jackknife finds the error of a mean, and of a minimum that it is too low.
TEST(BatchedReadings, KnowTheirErrors) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 1);
    constexpr unsigned points = 9, passes = 512;
    FilmImage image;
    image.width = points;
    image.height = 1;
    std::vector<double> sums(points);
    BatchedReadings readings(true);
    for (unsigned pass = 1; pass <= passes; ++pass) {
        image.passes = pass;
        image.radiance.clear();
        const double shared = noise(random); // photons that all points share
        for (double& sum : sums) {
            sum += 100 + shared + noise(random);
            image.radiance.insert(image.radiance.end(), 3, static_cast<float>(sum / pass));
        }
        readings.add(image);
        EXPECT_EQ(normFigures(readings, {0, points}).mean.isKnown(), pass >= fewestBatches) << pass;
    }
    const NormFigures figures = normFigures(readings, {0, points});
    const double single = std::sqrt(1 + 1.0 / points), error = single / std::sqrt(passes);
    EXPECT_GE(figures.mean.batches, 32u);
    // The estimate itself is known to 1 / sqrt(2 · 31) = 13 %; a third is 2.6 of that.
    EXPECT_NEAR(figures.mean.standardError, error, error / 3);
    EXPECT_NEAR(figures.mean.value, 100, 4 * error);
    EXPECT_LT(figures.mean.standardError, std::sqrt(2.0 / passes)) << "less than that of a point";
    EXPECT_LT(figures.overall.standardError, 0.01 * figures.minimum.standardError) << "what all share divides out";
    // Of nine points with equal illuminance the least lies 1.5 standard errors of a point below.
    EXPECT_NEAR(figures.minimum.bias, 1.485 / std::sqrt(passes), 3 / std::sqrt(passes));
    EXPECT_GT(figures.minimum.bias, 0);
    EXPECT_LE(figures.maximum.bias, 0);
}

} // namespace
} // namespace quasilux
