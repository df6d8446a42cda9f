// Environment maps: how they are looked up (values of Mitsuba 3.9.1), how directions are sampled, what photons carry, and renders
// against a quadrature. False-alarm rate of the tests of samplers 1e-4 together; of the renders 0.3 % each (Student t of 10 batches
// beyond 4 standard errors). Seeds are fixed.
#include "learn/guide.h"
#include "scene/color.h"
#include "scene/skies/sky_image.h"
#include "support/chi_squared.h"
#include "support/emitter_cases.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/stored_photons.h"
#include "support/wrong_learning.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;
using testing::HasSubstr;

constexpr int statisticalTests = 24;
constexpr size_t sampleCount = 200000;

EnvironmentImage imageOf(unsigned width, unsigned height, const std::function<Rgb(unsigned, unsigned)>& pixel) {
    EnvironmentImage image{width, height, {}, glm::dmat3(1)};
    for (unsigned row = 0; row < height; ++row)
        for (unsigned column = 0; column < width; ++column) image.pixels.push_back(pixel(column, row));
    return image;
}

glm::dmat3 turned() {
    const dvec3 x = glm::normalize(dvec3(1, 2, -0.5)), y = glm::normalize(glm::cross(x, dvec3(0.3, -1, 0.8)));
    return {x, y, glm::cross(x, y)};
}

EnvironmentImage mitsubaImage() {
    return imageOf(6, 5, [](unsigned c, unsigned r) {
        return Rgb{float((c * 7 + r * 3) % 11 + 1) / 4, float((c + r) % 4) * 0.5f, 0.25f * float(r + 1)};
    });
}

struct NamedImage {
    const char* name;
    EnvironmentImage image;
};
// A coloured gradient, turned; a small sun in a dim sky; light from the poles' pixels alone; from the ring beside a pole alone; one pixel
// among black ones, mirrored; the fewest pixels.
std::vector<NamedImage> images() {
    std::vector<NamedImage> all = {
        {"gradient", mitsubaImage()},
        {"sun", imageOf(144, 16,
                        [](unsigned c, unsigned r) {
                            return c == 9 && r == 4 ? Rgb{4000, 3000, 2000} : Rgb{0.1f, 0.2f, 0.3f};
                        })},
        {"poles", imageOf(8, 6,
                          [](unsigned c, unsigned r) {
                              return r % 5 == 0 ? Rgb{1, float(c), 0} : Rgb{};
                          })},
        {"ring", imageOf(8, 9,
                         [](unsigned c, unsigned r) {
                             return r == 1 || r == 7 ? Rgb{0, 1, float(c)} : Rgb{};
                         })},
        {"one", imageOf(9, 7,
                        [](unsigned c, unsigned r) {
                            return c == 0 && r == 3 ? Rgb{0, 5, 0} : Rgb{};
                        })},
        {"fewest", imageOf(1, 2, [](unsigned, unsigned r) {
             return Rgb{1, float(r + 1), 2};
         })}};
    all[0].image.axes = turned();
    all[4].image.axes = turned() * glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    return all;
}

// Mitsuba's lookup, in double precision.
dvec3 lookUp(const EnvironmentImage& image, const dvec3& direction) {
    const dvec3 d = glm::transpose(image.axes) * direction;
    const double turns = std::atan2(d.x, -d.z) / (2 * pi), x = (turns - std::floor(turns)) * image.width - 0.5;
    const double y = std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * (image.height - 1);
    const int column = int(std::floor(x)), row = std::min(int(y), int(image.height) - 2);
    const auto at = [&](int c, int r) {
        const Rgb& p = image.pixels[size_t(r) * image.width + size_t(c + int(image.width)) % image.width];
        return dvec3(p.r, p.g, p.b);
    };
    return glm::mix(glm::mix(at(column, row), at(column + 1, row), x - column),
                    glm::mix(at(column, row + 1), at(column + 1, row + 1), x - column), y - row);
}

dvec3 directionOf(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)};
}

// Midpoint rule over cosine and azimuth about the image's own axes.
dvec3 integral(const EnvironmentImage& image, const std::function<double(const dvec3&)>& weight) {
    constexpr int cosines = 2000, azimuths = 720;
    dvec3 sum(0);
    for (int i = 0; i < cosines; ++i)
        for (int j = 0; j < azimuths; ++j) {
            const dvec3 d = image.axes * directionOf(2 * (i + 0.5) / cosines - 1, 2 * pi * (j + 0.5) / azimuths);
            if (const double w = weight(d); w != 0) sum += w * lookUp(image, d);
        }
    return sum * (4 * pi / (cosines * azimuths));
}

TEST(EnvmapLookup, IsThatOfMitsuba) {
    EnvironmentImage image = mitsubaImage();
    for (Rgb& pixel : image.pixels) pixel = pixel * 2;
    const glm::dmat3 about_x(1, 0, 0, 0, 0, 1, 0, -1, 0); // rotate x by 90°, then z by 35°
    const double c = std::cos(35 * pi / 180), s = std::sin(35 * pi / 180);
    image.axes = glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1) * about_x;
    const auto [emitter, words] = makeEnvmap(image, {0, 0, 0}, 1);
    // emitter.eval(si) of mitsuba 3.9.1, scalar_rgb, of a bitmap with these pixels.
    const std::vector<std::pair<dvec3, dvec3>> expected = {
        {{1, 0, 0}, {3.541667, 1.25, 1.5}},
        {{-0.6, 0.8, 0}, {4.031165, 2.531165, 1.5}},
        {{0.100458129, -0.200916258, 0.974443852}, {3.658404, 2.189895, 0.644235}},
        {{0.48, 0.6, -0.64}, {3.371067, 1.038144, 1.942131}},
        {{-0.315789474, -0.947368421, 0.0526315789}, {2.262292, 1.323539, 1.466478}},
        {{0.0100984346, 0.0201968691, -0.999745022}, {2.873117, 0.551840, 2.485623}}};
    for (const auto& [direction, value] : expected) {
        EXPECT_LT(glm::length(radiances(emitter, {direction}, words)[0] - value), 2e-5);
        EXPECT_LT(glm::length(lookUp(image, direction) - value), 2e-5) << "what the tests below are held against";
    }
}

TEST(EnvmapTable, MeanRadianceIsTheIntegral) {
    for (const auto& [name, image] : images()) {
        const dvec3 exact = integral(image, [](const dvec3&) { return 1.0; }) / (4 * pi);
        const Rgb mean = makeEnvironmentTable(image).meanRadiance;
        EXPECT_LT(glm::length(dvec3(mean.r, mean.g, mean.b) - exact), 1e-4 * glm::length(exact)) << name;
    }
}

TEST(EnvmapTable, DimPixelsBesideASunKeepAProbability) {
    const auto table = makeEnvironmentTable(imageOf(2048, 4, [](unsigned c, unsigned r) {
        return c == 700 && r == 1 ? Rgb{1e9f, 1e9f, 1e9f} : Rgb{1e-3f, 1e-3f, 1e-3f};
    }));
    shared::EnvironmentMap head;
    std::memcpy(&head, table.words.data(), sizeof head);
    const auto* columns = reinterpret_cast<const float*>(table.words.data() + head.columns);
    for (unsigned k = 1; k < 3 * 2048; ++k) {
        if (k % 2048 == 0) continue; // of the next row
        ASSERT_GT(columns[k], columns[k - 1]) << k;
    }
}

/// p-value of `directions` against the density of `densityOf` over the image's own cosine and azimuth.
double fit(const EnvironmentImage& image, const std::vector<dvec3>& directions, const EnvironmentImage& densityOf) {
    const SampleGrid grid{-1, 1, -pi, pi, 24, 24};
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const dvec3& direction : directions) {
        const dvec3 d = glm::transpose(image.axes) * direction;
        ++counts[grid.cell(std::clamp(d.y, -1.0, 1.0), std::atan2(d.x, -d.z))];
    }
    const auto points = gridQuadrature(grid, 40);
    std::vector<dvec3> towards;
    for (const QuadraturePoint& q : points) towards.push_back(image.axes * directionOf(q.u, q.v));
    const auto [emitter, words] = makeEnvmap(densityOf, {0, 0, 0}, 1);
    const auto pdfs = directionPdfs({emitter}, 0, {0, 0, 0}, towards, towards, words);
    std::vector<double> probabilities(grid.cells());
    for (size_t i = 0; i < points.size(); ++i) probabilities[points[i].cell] += pdfs[i] * points[i].weight;
    // What the midpoint rule makes of a density with kinks is known to 1e-3.
    double all = 0;
    for (const double p : probabilities) all += p;
    EXPECT_NEAR(all, 1, 4e-3);
    for (double& p : probabilities) p /= all;
    return chiSquaredPValue(counts, probabilities);
}

std::vector<dvec3> sampledDirections(const EnvironmentImage& image) {
    const auto [emitter, words] = makeEnvmap(image, {0, 0, 0}, 1);
    std::vector<dvec3> directions;
    for (const SampledEmitter& s :
         sampleDirections({emitter}, {}, {0, 0, 0}, uniformNumbers(3 * sampleCount, 21), words))
        directions.push_back(s.direction); // also of black places
    return directions;
}

TEST(EnvmapSampling, DirectionsFollowTheDensity) {
    for (const auto& [name, image] : images())
        EXPECT_GT(fit(image, sampledDirections(image), image), significanceLevel(statisticalTests)) << name;
    EnvironmentImage wrong = images()[0].image;
    std::rotate(wrong.pixels.begin(), wrong.pixels.begin() + 6, wrong.pixels.end());
    EXPECT_LT(fit(wrong, sampledDirections(images()[0].image), wrong), significanceLevel(statisticalTests))
        << "negative control: rows moved up by one";
}

TEST(EnvmapSampling, SamplesHaveTheRadianceAndDensityOfTheirDirection) {
    for (const auto& [name, image] : images()) {
        const auto [emitter, words] = makeEnvmap(image, {0, 0, 0}, 1);
        auto numbers = uniformNumbers(3 * 20000, 22);
        for (const float u : extremeNumbers(3)) numbers.push_back(u);
        const auto samples = sampleDirections({emitter}, {}, {0, 0, 0}, numbers, words);
        std::vector<dvec3> directions;
        for (const auto& s : samples) directions.push_back(s.direction);
        const auto pdfs = directionPdfs({emitter}, 0, {0, 0, 0}, directions, directions, words);
        double most = 0, wrong = 0;
        for (size_t i = 0; i < samples.size(); ++i) {
            const auto& s = samples[i];
            ASSERT_NEAR(glm::length(s.direction), 1, 1e-6) << name;
            if (!s.valid) continue;
            ASSERT_TRUE(std::isinf(s.distance) && s.pdf > 0 && std::isfinite(s.radianceOverPdf.y)) << name;
            if (i >= 20000) continue; // at a pole there is no azimuth, so its density is that of any of its cells
            const dvec3 exact = lookUp(image, s.direction);
            const double scale = glm::length(exact) +
                                 1e-3 * glm::length(dvec3(emitter.radiance.r, emitter.radiance.g, emitter.radiance.b));
            wrong += glm::length(s.radianceOverPdf * s.pdf - exact) > 2e-3 * scale;
            wrong += std::abs(pdfs[i] / s.pdf - 1) > 1e-2;
            most = std::max(most, (s.radianceOverPdf.x + s.radianceOverPdf.y + s.radianceOverPdf.z) /
                                      (4 * pi * 3 * mean(emitter.radiance)));
        }
        // Rounding puts a few samples into the next cell, where the density of dim ones differs.
        EXPECT_LT(wrong, 1e-3 * double(samples.size())) << name;
        EXPECT_LT(most, 2) << name << ": no sample is much brighter than the mean";
    }
}

TEST(EnvmapSampling, EveryPlaneReceivesTheIntegral) {
    for (const auto& [name, image] : images()) {
        const auto [emitter, words] = makeEnvmap(image, {0, 0, 0}, 1);
        const dvec3 normal = glm::normalize(dvec3(0.3, 0.8, -0.5));
        const double exact = integral(image, [&](const dvec3& d) { return std::max(glm::dot(d, normal), 0.0); }).y;
        double sum = 0, squares = 0;
        for (const SampledEmitter& s :
             sampleDirections({emitter}, {}, {5, 6, 7}, uniformNumbers(3 * sampleCount, 23), words)) {
            const double e = s.valid ? s.radianceOverPdf.y * std::max(glm::dot(s.direction, normal), 0.0) : 0;
            sum += e;
            squares += e * e;
        }
        const double mean = sum / sampleCount;
        const double error = std::sqrt((squares / sampleCount - mean * mean) / sampleCount) + 1e-4 * exact;
        EXPECT_GT(normalPValue((mean - exact) / error), significanceLevel(statisticalTests)) << name;
        if (std::string(name) != "gradient") continue;
        EXPECT_LT(normalPValue((mean - 1.05 * exact) / error), significanceLevel(statisticalTests))
            << "negative control";
    }
}

TEST(EnvmapPhotons, CarryTheFluxAndFollowTheDensity) {
    const dvec3 centre(1, 2, 3);
    const double radius = 2;
    for (const auto& [name, image] : images()) {
        const auto [emitter, words] = makeEnvmap(image, centre, radius);
        const double power = 4 * pi * pi * radius * radius * mean(emitter.radiance);
        std::vector<dvec3> from;
        const SampleGrid disc{0, 1, -pi, pi, 8, 8};
        std::vector<uint64_t> places(disc.cells() + 1);
        double sum = 0, squares = 0;
        for (const EmittedParticle& p : samplePhotons({emitter}, {}, uniformNumbers(5 * sampleCount, 24), words)) {
            from.push_back(-p.direction);
            const double flux = (p.flux.x + p.flux.y + p.flux.z) / 3;
            sum += flux;
            squares += flux * flux;
            const dvec3 offset = (p.position - centre) / radius;
            ASSERT_NEAR(glm::dot(offset, p.direction), -1, 1e-5) << name << ": starts before everything in the scene";
            const dvec3 s = glm::normalize(
                glm::cross(p.direction, std::abs(p.direction.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
            const double x = glm::dot(offset, s), y = glm::dot(offset, glm::cross(p.direction, s));
            ++places[disc.cell(std::min(x * x + y * y, 1.0), std::atan2(y, x))];
        }
        const double mean = sum / sampleCount,
                     error = std::sqrt(std::max(squares / sampleCount - mean * mean, 0.0) / sampleCount) + 1e-4 * power;
        EXPECT_GT(normalPValue((mean - power) / error), significanceLevel(statisticalTests)) << name;
        EXPECT_GT(fit(image, from, image), significanceLevel(statisticalTests)) << name;
        EXPECT_GT(chiSquaredPValue(places, std::vector<double>(disc.cells(), 1.0 / disc.cells())),
                  significanceLevel(statisticalTests))
            << name;
    }
}

TEST(EnvmapPhotons, AreMadeOfTheNumbersThatTheInversionGives) {
    for (const auto& [name, image] : images()) {
        const auto [emitter, words] = makeEnvmap(image, {1, 2, 3}, 2);
        const auto numbers = uniformNumbers(5 * 5000, 25);
        const auto inverted = invertedNumbers(emitter, numbers, words);
        const auto photons = samplePhotons({emitter}, {}, numbers, words),
                   again = samplePhotons({emitter}, {}, inverted, words);
        size_t wrong = 0;
        for (size_t i = 0; i < photons.size(); ++i)
            wrong += glm::length(photons[i].direction - again[i].direction) > 2e-3 ||
                     glm::length(photons[i].position - again[i].position) > 0.01;
        EXPECT_LT(wrong, 5u) << name;
    }
}

// --- renders ---

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

/// Flux of direct photons on the cube over that by `learn`ed sources, in standard errors of the difference from plain emission.
TEST(EnvmapPhotons, GoThroughOpeningsOnce) {
    FlattenSettings flattening;
    flattening.largestRadius = [](double) { return 0.1; };
    const Scene scene = cubeUnder(images()[1].image);
    const auto fluxBy = [&](int apart) {
        DeviceScene flat = flattenScene(scene, flattening);
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
    writeImage(files, imageOf(2, 2, [](unsigned, unsigned) { return Rgb{}; }), "black.exr");
    writeImage(files, imageOf(2, 2, [](unsigned, unsigned) { return Rgb{1, INFINITY, 1}; }), "infinite.exr");
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {envmap(""), {"scene.xml:4:1", "emitter 'envmap' needs <string name=\"filename\""}},
        {envmap("<string name=\"filename\" value=\"none.exr\"/>"), {"scene.xml:5:1", "none.exr"}},
        {envmap("<string name=\"filename\" value=\"flat.exr\"/>"),
         {"scene.xml:5:1", "4 x 1 pixels", "at least two rows"}},
        {envmap("<string name=\"filename\" value=\"black.exr\"/>"), {"scene.xml:5:1", "is black"}},
        {envmap("<string name=\"filename\" value=\"infinite.exr\"/>"),
         {"scene.xml:5:1", "pixel 0, 0 has the value inf"}},
        {envmap(skyFile + "<float name=\"scale\" value=\"0\"/>"), {"scene.xml:6:1", "scale"}},
        {envmap(skyFile + "<float name=\"sclae\" value=\"1\"/>"),
         {"scene.xml:6:1", "unknown parameter 'sclae'", "'scale'"}},
        {envmap(skyFile + "<transform name=\"to_world\"><scale value=\"2\"/></transform>"),
         {"scene.xml:6:1", "may turn and mirror it, not scale"}},
        {"<emitter type=\"constant\"/>\n" + envmap(skyFile),
         {"scene.xml:5:1", "a second emitter all around the scene, after the emitter 'constant' at ",
          "scene.xml:4:1; keep"}},
        {"<shape type=\"cube\">\n" + envmap(skyFile) + "</shape>", {"scene.xml:5:1", "put it directly into <scene>"}}};
    test::expectErrors(files, cases);
}

// A uniform image gives pi, whatever its rows; of one that is bright in its first row alone it is the cone of a hat about the zenith.
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
