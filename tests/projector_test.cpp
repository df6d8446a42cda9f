// Projectors: their picture (values of Mitsuba 3.9.1), photons, light on a floor, and reading.
// False-alarm rate of the tests of samplers 1e-4 together; renders are held to 4 standard errors of 10 batches (Student
// t: 0.3 % each). Seeds are fixed.
#include "support/chi_squared.h"
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

constexpr int statisticalTests = 6;
constexpr size_t sampleCount = 100000;
constexpr double degree = pi / 180;

/// The picture of writeSixPixels, or else a colour, from the same place.
TexturedEmitter projector(bool withPicture) {
    test::SceneFiles files;
    writeSixPixels(files.path("six.exr"));
    const std::string irradiance =
        withPicture ? R"(<texture type="bitmap" name="irradiance"><string name="filename" value="six.exr"/>
        <string name="wrap_mode" value="clamp"/></texture>)"
                    : R"(<rgb name="irradiance" value="1,2,3"/>)";
    return lastEmitter(loadScene(
        files.write("scene.xml",
                    test::sceneWith(R"(<shape type="rectangle"/><emitter type="projector"><float name="fov" value="50"/>
        <float name="scale" value="3"/><transform name="to_world"><lookat origin="1,-2,3" target="2,0,4" up="0,0,1"/></transform>)" +
                                    irradiance + "</emitter>"))));
}

TEST(Projector, ThrowsItsPictureAsInMitsuba) {
    // sample_direction of mitsuba 3.9.1, scalar_rgb, times distance squared.
    const std::pair<dvec3, dvec3> expected[] = {{{0, 0, 1}, {2.35619, 11.78097, 11.78097}},
                                                {{0.2, 0.1, 1}, {0.90414, 4.52068, 17.56839}},
                                                {{-0.3, 0.2, 1}, {2.22463, 11.12314, 15.96832}},
                                                {{0.4, -0.3, 1}, {3.95146, 19.75729, 14.48868}},
                                                {{-0.1, -0.2, 1}, {4.38235, 21.91176, 7.13374}},
                                                {{0.47, 0.1, 1}, {0, 0, 0}},
                                                {{0.1, 0.32, 1}, {0, 0, 0}},
                                                {{0, 0, -1}, {0, 0, 0}}};
    std::vector<dvec3> directions;
    for (const auto& [direction, value] : expected) directions.push_back(askew(direction));
    const auto found = intensities(projector(true), directions);
    for (size_t k = 0; k < directions.size(); ++k) EXPECT_LT(glm::length(found[k] - expected[k].second), 2e-4) << k;
    // Of a colour the picture is a square, of edge 0.932615 at depth 1.
    const auto plain = intensities(projector(false), {askew({0, 0.46, 1}), askew({0, 0.47, 1})});
    EXPECT_LT(glm::length(plain[0] - 3.0 * dvec3(4.189757, 8.379514, 12.56927)), 2e-4);
    EXPECT_EQ(plain[1], dvec3(0));
}

TEST(Projector, PhotonsAreEvenOnThePictureAndCarryTheIntensity) {
    for (const bool withPicture : {false, true}) {
        const TexturedEmitter emitter = projector(withPicture);
        const auto numbers = uniformNumbers(2 * sampleCount, 34);
        const auto photons = directedPhotons(emitter, numbers);
        std::vector<dvec3> directions;
        for (const auto& p : photons) directions.push_back(p.direction);
        const auto expected = intensities(emitter, directions);
        const SampleGrid grid{-1, 1, -1, 1, 12, 12};
        std::vector<uint64_t> counts(grid.cells() + 1);
        double sum = 0, squares = 0;
        const double width = 2 * std::tan(25 * degree), height = withPicture ? width / 1.5 : width;
        const dvec3 forward = askew({0, 0, 1}), x = askew({1, 0, 0}), y = askew({0, 1, 0});
        for (size_t i = 0; i < photons.size(); ++i) {
            const dvec3& d = photons[i].direction;
            const double cosine = glm::dot(d, forward);
            ++counts[grid.cell(std::clamp(2 / width * glm::dot(d, x) / cosine, -1.0, 1.0),
                               std::clamp(2 / height * glm::dot(d, y) / cosine, -1.0, 1.0))];
            // At the very edge rounding may put the direction outside.
            const dvec3 flux = expected[i] * (std::pow(cosine, 3) * width * height);
            if (flux.x > 0 || flux.z > 0) {
                ASSERT_LT(glm::length(photons[i].flux - flux), 2e-4 * glm::length(flux) + 1e-4);
            }
            ASSERT_NEAR(photons[i].found.x, numbers[2 * i], 1e-5);
            ASSERT_NEAR(photons[i].found.y, numbers[2 * i + 1], 1e-5);
            const double mean = (photons[i].flux.x + photons[i].flux.y + photons[i].flux.z) / 3;
            sum += mean;
            squares += mean * mean;
        }
        EXPECT_GT(chiSquaredPValue(counts, std::vector<double>(grid.cells(), 1.0 / grid.cells())),
                  significanceLevel(statisticalTests));
        const double mean = sum / sampleCount,
                     error = std::sqrt(std::max(squares / sampleCount - mean * mean, 0.0) / sampleCount);
        const double both = std::hypot(error, 5e-4 * emitter.power);
        EXPECT_GT(normalPValue((mean - emitter.power) / both), significanceLevel(statisticalTests));
        EXPECT_LT(normalPValue((mean - 1.05 * emitter.power) / both), significanceLevel(statisticalTests))
            << "negative control";
    }
}

/// A floor of albedo 0.5, on which a projector at height 2 throws two halves; the image lies within the bright one,
/// away from its edges.
Scene floorUnderProjector() {
    test::SceneFiles files;
    writeFloats(files.path("halves.exr"), 2, 2, {2, 2, 2, 0.25f, 0.25f, 0.25f, 2, 2, 2, 0.25f, 0.25f, 0.25f});
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="orthographic"><transform name="to_world">
        <scale value="0.3"/><rotate y="1" angle="180"/><translate x="0.55" z="5"/></transform><film type="hdrfilm"><rfilter type="box"/>
        <integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
        <emitter type="projector"><float name="fov" value="60"/><texture type="bitmap" name="irradiance"><string name="filename" value="halves.exr"/>
        <string name="filter_type" value="nearest"/></texture><transform name="to_world"><rotate x="1" angle="180"/><translate z="2"/>
        </transform></emitter><shape type="rectangle"><transform name="to_world"><scale value="4"/></transform><bsdf type="diffuse"/></shape>
        </scene>)"));
}

// Irradiance pi E / height^2 of the left half: local +x, which is the world's.
TEST(ProjectorRender, FloorIsLitEvenlyWhateverWasLearned) { expectMeanOfImage(floorUnderProjector(), 0.5 * 2 / 4.0); }

std::string projectorWith(const std::string& parameters) {
    return "<emitter type=\"projector\">\n" + parameters + "</emitter>";
}

TEST(ProjectorReader, ReadsWhatIsGivenAndDefaults) {
    const Scene scene = test::loadBody(
        projectorWith(
            "<rgb name=\"irradiance\" value=\"1,2,3\"/><float name=\"scale\" value=\"2\"/><float name=\"fov\" "
            "value=\"90\"/><transform name=\"to_world\"><scale value=\"3\"/><translate x=\"4\"/></transform>") +
        projectorWith("") +
        projectorWith(
            "<texture type=\"checkerboard\" name=\"irradiance\"/><string name=\"focal_length\" value=\"35mm\"/>"));
    const auto& first = scene.pointEmitters.at(1);
    ASSERT_TRUE(first.projector);
    test::expectNear(first.position, {4, 0, 0});
    test::expectNear(first.projector->axis, {0, 0, 1});
    test::expectNear(first.projector->picture.u, {-0.5, 0, 0});
    test::expectNear(first.projector->picture.v, {0, -0.5, 0});
    EXPECT_FALSE(first.projector->picture.texture);
    EXPECT_NEAR(first.intensity.b, 18 * pi, 1e-5) << "a scale of to_world multiplies, as in Mitsuba 3.9.1";
    const auto widthOf = [](const PointEmitter& emitter) {
        return 2 * std::atan(0.5 / glm::length(emitter.projector->picture.u));
    };
    EXPECT_NEAR(widthOf(scene.pointEmitters.at(2)) / degree, 34.0221, 1e-3) << "mitsuba 3.9.1: x_fov";
    EXPECT_NEAR(scene.pointEmitters[2].intensity.g, pi, 1e-6);
    EXPECT_TRUE(scene.pointEmitters.at(3).projector->picture.texture);
    EXPECT_NEAR(widthOf(scene.pointEmitters[3]) / degree, 47.2163, 1e-3);
}

TEST(ProjectorReader, SaysWhatIsWrong) {
    test::SceneFiles files;
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {projectorWith("<float name=\"fov\" value=\"180\"/>"), {"scene.xml:5:1", "between 0 and 180"}},
        {projectorWith("<float name=\"fov\" value=\"80\"/><string name=\"focal_length\" value=\"35mm\"/>"),
         {"scene.xml:5:", "emitter 'projector' has both fov and focal_length"}},
        {projectorWith("<float name=\"scale\" value=\"-1\"/>"), {"scene.xml:5:1", "scale"}},
        {projectorWith("<rgb name=\"irradiance\" value=\"-1\"/>"), {"scene.xml:5:1", "no channel may be negative"}},
        {projectorWith("<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
         {"scene.xml:5:1", "emitter 'projector'", "scales directions differently"}},
        {projectorWith("<float name=\"intensity\" value=\"1\"/>"), {"scene.xml:5:1", "unknown parameter 'intensity'"}}};
    test::expectErrors(files, cases);
}

} // namespace
} // namespace quasilux
