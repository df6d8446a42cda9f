// Environment maps of scenes: renders against a quadrature, photons through openings, reading, and the irradiance of
// the ground. False-alarm rate of the renders 0.3 % each (Student t of 10 batches beyond 4 standard errors). Seeds are
// fixed.
#include "learn/guide.h"
#include "scene/skies/sky_image.h"
#include "support/environment_images.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/stored_photons.h"
#include "support/wrong_learning.h"
#include "support/wrong_rules.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;
using test::imageOf;
using test::images;
using test::integral;
using testing::HasSubstr;

std::string writeImage(const test::SceneFiles& files, const EnvironmentImage& image,
                       const std::string& name = "sky.exr") {
    const std::string path = files.path(name);
    const auto file = OIIO::ImageOutput::create(path);
    EXPECT_TRUE(file->open(path, OIIO::ImageSpec(int(image.width), int(image.height), 3, OIIO::TypeDesc::FLOAT)));
    EXPECT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data()));
    EXPECT_TRUE(file->close());
    return path;
}

// The upper face of a cube of albedo 0.5 fills the picture, under an image whose +y is the world's +z.
Scene cubeUnder(const EnvironmentImage& image) {
    test::SceneFiles files;
    writeImage(files, image);
    return loadScene(files.write("scene.xml", R"(<scene version="3.0.0"><sensor type="orthographic">
        <transform name="to_world"><scale x="0.7" y="0.7"/><rotate y="1" angle="180"/><translate z="5"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film>
        </sensor><emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="2"/>
        <transform name="to_world"><rotate x="1" angle="90"/></transform></emitter>
        <shape type="cube"><bsdf type="diffuse"/></shape></scene>)"));
}

TEST(EnvmapRender, AFaceShowsTheIntegralByEmittersAndByPhotonsWhateverWasLearned) {
    // Grey, so that luminance is any channel.
    const auto grey = imageOf(12, 8, [](unsigned c, unsigned r) {
        const float v = c == 5 && r == 2 ? 30.f : 0.1f * float(c % 4 + r);
        return Rgb{v, v, v};
    });
    const Scene scene = cubeUnder(grey);
    // In the image's own frame the face looks along +y.
    const double truth = 2 * 0.5 / pi * integral(grey, [](const dvec3& d) { return std::max(d.y, 0.0); }).y;
    for (const DirectLight direct : {DirectLight::emitters, DirectLight::photons})
        for (const bool wrongly : {false, true}) {
            const auto result = meanOfImage(scene, direct, wrongly);
            const double allowed = 4 * result.standardError + 0.003 * truth;
            EXPECT_NEAR(result.mean, truth, allowed) << "photons " << (direct == DirectLight::photons) << wrongly;
            EXPECT_LT(allowed, 0.03 * truth) << "too noisy to tell anything";
            EXPECT_GT(std::abs(result.mean - 1.05 * truth), allowed) << "negative control";
        }
}

RenderSettings guided(const Scene& scene) {
    RenderSettings settings;
    settings.emission = Emission::guided;
    settings.photonsPerPass = 4000;
    settings.furtherFeatures = test::sharedFeatures(scene);
    return settings;
}

// A sky whose zenith is dimmer than the rest: what exceeds its mean is a ring above the horizon, and the ground.
EnvironmentImage dimZenith(float radiance) {
    return imageOf(24, 13, [radiance](unsigned, unsigned r) {
        const float v = r < 4 ? radiance : 2.f;
        return Rgb{v, v, v};
    });
}

TEST(EnvmapRender, IsTheSameBySamplesOfWhatExceedsTheMean) {
    const EnvironmentImage sky = dimZenith(1.8f); // by radiance it is sampled nearly evenly
    const Scene scene = cubeUnder(sky);
    const double truth = 2 * 0.5 / pi * integral(sky, [](const dvec3& d) { return std::max(d.y, 0.0); }).y;
    const std::vector<int> one(size_t{scene.sensor.width} * scene.sensor.height, 0);
    RenderSettings settings = guided(scene);
    const auto learned = learnedOf(scene, settings);
    for (const unsigned map : {0u, 1u}) {
        learned->tables.directEnvironment = map;
        const auto right = renderGroups(scene, settings, one, 10, 32, learned)[0];
        const double allowed = 4 * right.standardError + 0.003 * truth;
        EXPECT_NEAR(right.mean, truth, allowed) << map;
        if (map == 0) continue;
        settings.controlOptions = optionOf(test::SkyRule::otherDensity);
        const auto wrong = renderGroups(scene, settings, one, 10, 32, learned)[0];
        EXPECT_GT(std::abs(wrong.mean - truth), allowed + 4 * wrong.standardError) << "negative control";
    }
}

// Through a hole in a roof a floor sees the zenith alone: samples are better by radiance. An open face's own directions
// find the sky, dim or not.
TEST(EnvmapLearning, SamplesWhatExceedsTheMeanWhereThatServes) {
    const auto mapOf = [](const Scene& scene) { return learnedOf(scene, guided(scene))->tables.directEnvironment; };
    EXPECT_EQ(mapOf(cubeUnder(dimZenith(0.2f))), 1u);
    test::SceneFiles files;
    writeImage(files, dimZenith(0.2f));
    const auto roof = [](const char* scale, const char* place) {
        return fmt::format(
            R"(<shape type="rectangle"><transform name="to_world"><scale {}/><translate {} z="1"/></transform>
            <bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>)",
            scale, place);
    };
    const Scene room = loadScene(files.write(
        "room.xml",
        R"(<scene version="3.0.0"><sensor type="perspective"><float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0,-1.5,0.5" target="0,0,0" up="0,0,1"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="32"/><integer name="height" value="32"/></film></sensor>
        <emitter type="envmap"><string name="filename" value="sky.exr"/><transform name="to_world"><rotate x="1" angle="90"/></transform>
        </emitter><shape type="rectangle"><transform name="to_world"><scale value="9"/></transform><bsdf type="diffuse"/></shape>)" +
            roof(R"(x="4.4" y="9")", R"(x="-4.6")") + roof(R"(x="4.4" y="9")", R"(x="4.6")") +
            roof(R"(x="0.2" y="4.4")", R"(y="-4.6")") + roof(R"(x="0.2" y="4.4")", R"(y="4.6")") + "</scene>"));
    EXPECT_EQ(mapOf(room), 0u);
}

/// Flux of direct photons on the cube over that by `learn`ed sources, in standard errors of the difference from plain
/// emission.
TEST(EnvmapPhotons, GoThroughOpeningsOnce) {
    const Scene scene = cubeUnder(images()[1].image);
    const auto fluxBy = [&](int apart) {
        DeviceScene flat = flattenScene(scene);
        LearnedTables learned;
        learned.guide = plainGuide(flat.emitters);
        if (apart >= 0) {
            Opening window{{0.2, 0.1, 1.2}, {1, 0, 0}, {0, 0.8, 0.6}, 0.4, 0.3},
                other{{0.1, 0.2, 1.1}, {1, 0, 0}, {0, 1, 0}, 0.5, 0.5};
            std::vector<shared::GuideSource> sources = {openingSource(0, 0, window), openingSource(0, 0, other),
                                                        plainSource(0, 0)};
            std::vector<SourceBox> boxes;
            for (unsigned k = 0; k < 3; ++k) {
                if (apart == 0) sources[k].first = k;
                SourceBox whole{k, {}};
                whole.box.probability = k < 2 ? 0.3 : 0.4;
                boxes.push_back(whole);
            }
            learned.guide = makeGuideTables(flat.emitters, sources, boxes);
            learned.guide.isGuided = true;
        }
        setLearned(flat, learned);
        RenderSettings settings;
        settings.direct = DirectLight::photons;
        return directShareOfFlux(flat, settings);
    };
    const MeanAndError plain = fluxBy(-1), guided = fluxBy(1), twice = fluxBy(0);
    EXPECT_LT(std::abs(guided.mean - plain.mean), 4 * std::hypot(guided.standardError, plain.standardError));
    EXPECT_GT(twice.mean - plain.mean, 4 * std::hypot(twice.standardError, plain.standardError)) << "negative control";
}

// --- reading ---

std::string envmap(const std::string& parameters) { return "<emitter type=\"envmap\">\n" + parameters + "</emitter>"; }
const std::string skyFile = "<string name=\"filename\" value=\"sky.exr\"/>\n";

TEST(EnvmapReader, ReadsWhatIsGiven) {
    test::SceneFiles files;
    writeImage(files, imageOf(3, 2, [](unsigned c, unsigned r) { return Rgb{float(c), float(r), -1}; }));
    const Scene scene = loadScene(files.write(
        "scene.xml", test::sceneWith(envmap(
                         skyFile + "<float name=\"scale\" value=\"3\"/><boolean "
                                   "name=\"mis_compensation\" value=\"true\"/><transform name=\"to_world\"><rotate "
                                   "y=\"1\" angle=\"90\"/><translate x=\"7\"/></transform>"))));
    ASSERT_TRUE(scene.surroundings && scene.surroundings->image);
    const EnvironmentImage& image = *scene.surroundings->image;
    EXPECT_EQ(image.width, 3u);
    EXPECT_EQ(image.height, 2u);
    EXPECT_EQ(image.pixels[5].r, 6);
    EXPECT_EQ(image.pixels[5].g, 3);
    EXPECT_EQ(image.pixels[5].b, 0) << "negative";
    EXPECT_THAT(scene.warnings.at(0), HasSubstr("scene.xml:5:1: 6 of the 6 pixels of 'sky.exr' are negative"));
    EXPECT_LT(glm::length(image.axes * dvec3(0, 0, 1) - dvec3(1, 0, 0)), 1e-12);
}

TEST(EnvmapReader, SaysWhatIsWrong) {
    test::SceneFiles files;
    writeImage(files, imageOf(2, 2, [](unsigned, unsigned) { return Rgb{1, 1, 1}; }));
    writeImage(files, imageOf(4, 1, [](unsigned, unsigned) { return Rgb{1, 1, 1}; }), "flat.exr");
    writeImage(files, imageOf(2, 2, [](unsigned, unsigned) { return Rgb{1, INFINITY, 1}; }), "infinite.exr");
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {envmap(""), {"scene.xml:4:1", "emitter 'envmap' needs <string name=\"filename\""}},
        {envmap("<string name=\"filename\" value=\"none.exr\"/>"), {"scene.xml:5:1", "none.exr"}},
        {envmap("<string name=\"filename\" value=\"flat.exr\"/>"),
         {"scene.xml:5:1", "4 x 1 pixels", "at least two rows"}},
        {envmap("<string name=\"filename\" value=\"infinite.exr\"/>"),
         {"scene.xml:5:1", "pixel 0, 0 has the value inf"}},
        {envmap(skyFile + "<float name=\"scale\" value=\"-1\"/>"), {"scene.xml:6:1", "scale"}},
        {envmap(skyFile + "<float name=\"sclae\" value=\"1\"/>"),
         {"scene.xml:6:1", "unknown parameter 'sclae'", "'scale'"}},
        {envmap(skyFile + "<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
         {"scene.xml:6:1", "may turn, mirror and scale it alike"}},
        {"<emitter type=\"constant\"/>\n" + envmap(skyFile),
         {"scene.xml:5:1", "a second emitter all around the scene, after the emitter 'constant' at ",
          "scene.xml:4:1; keep"}},
        {"<shape type=\"cube\">\n" + envmap(skyFile) + "</shape>", {"scene.xml:5:1", "put it directly into <scene>"}}};
    test::expectErrors(files, cases);
}

// A uniform image gives pi, whatever its rows; of one that is bright in its first row alone it is the cone of a hat
// about the zenith.
TEST(IrradianceOfGround, IsTheIntegralOfTheUpperHalf) {
    for (const unsigned height : {2u, 3u, 4u, 9u, 361u}) {
        const EnvironmentImage even{4, height, std::vector<Rgb>(4 * height, {1, 2, 3})};
        const glm::dvec3 found = irradianceOfGround(even);
        EXPECT_NEAR(found.x, pi, 1e-9) << height;
        EXPECT_NEAR(found.z, 3 * pi, 1e-9);
    }
    EnvironmentImage zenith{4, 5, std::vector<Rgb>(20, {0, 0, 0})};
    for (unsigned column = 0; column < 4; ++column) zenith.pixels[column] = {1, 1, 1};
    constexpr int steps = 20000;
    double truth = 0;
    for (int k = 0; k < steps; ++k) {
        const double angle = pi / 4 * (k + 0.5) / steps;
        truth += 2 * pi * (1 - angle / (pi / 4)) * std::sin(angle) * std::cos(angle) * (pi / 4 / steps);
    }
    EXPECT_NEAR(irradianceOfGround(zenith).y, truth, 1e-7);
}

} // namespace
} // namespace quasilux
