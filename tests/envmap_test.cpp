// Environment maps: how they are looked up (values of Mitsuba 3.9.1), how directions are sampled, and what photons
// carry. False-alarm rate 1e-4 together; seeds are fixed. In scenes: envmap_scene_test.
#include "learn/guide.h"
#include "prepare/environment_cells.h"
#include "scene/color.h"
#include "scene/skies/sky_image.h"
#include "support/chi_squared.h"
#include "support/emitter_cases.h"
#include "support/environment_images.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/stored_photons.h"
#include "support/wrong_learning.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;
using test::directionOf;
using test::imageOf;
using test::images;
using test::integral;
using test::lookUp;
using test::mitsubaImage;

constexpr int statisticalTests = 28;
constexpr size_t sampleCount = 200000;

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

// Larger cells than the image's own, where these hardly add variance.
TEST(EnvmapTable, LargerCellsSampleWhatHasNoContrast) {
    const auto cellsDown = [](const EnvironmentImage& image) {
        const EnvironmentCells cells(image);
        EXPECT_EQ(cells.weights().size(), cells.down() + 1 == image.height ? 0 : (cells.down() + 1) * cells.across());
        return cells.down();
    };
    const auto sky = [](float sun) {
        return imageOf(1440, 721, [sun](unsigned c, unsigned r) {
            const float up = std::cos(std::numbers::pi_v<float> * float(r) / 720);
            const float v = up < 0 ? 0.2f : c == 300 && r == 200 ? sun : 1 + 2 * up; // overcast, over dark ground
            return Rgb{v, v, v};
        });
    };
    EXPECT_LE(cellsDown(sky(0)), 128u);
    EXPECT_EQ(cellsDown(sky(1e6f)), 720u) << "a sun of one pixel";
    EXPECT_EQ(cellsDown(imageOf(200, 101, [](unsigned, unsigned) { return Rgb{1, 1, 1}; })), 100u) << "few pixels";
}

/// The map by which direct light may be sampled instead, as if there were no other.
std::vector<uint32_t> secondMap(const std::vector<uint32_t>& words) {
    return {words.begin() + sizeof(shared::EnvironmentMap) / sizeof(uint32_t), words.end()};
}

enum class By { radiance, whatExceedsTheMean };

std::pair<shared::Emitter, std::vector<uint32_t>> sampledBy(const EnvironmentImage& image, By by) {
    auto made = makeEnvmap(image, {0, 0, 0}, 1);
    if (by == By::whatExceedsTheMean) made.second = secondMap(made.second);
    return made;
}

/// p-value of `directions` against the density of `densityOf` over the image's own cosine and azimuth.
double fit(const EnvironmentImage& image, const std::vector<dvec3>& directions, const EnvironmentImage& densityOf,
           By by = By::radiance) {
    const SampleGrid grid{-1, 1, -pi, pi, 24, 24};
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const dvec3& direction : directions) {
        const dvec3 d = glm::transpose(image.axes) * direction;
        ++counts[grid.cell(std::clamp(d.y, -1.0, 1.0), std::atan2(d.x, -d.z))];
    }
    const auto points = gridQuadrature(grid, 40);
    std::vector<dvec3> towards;
    for (const QuadraturePoint& q : points) towards.push_back(image.axes * directionOf(q.u, q.v));
    const auto [emitter, words] = sampledBy(densityOf, by);
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

std::vector<dvec3> sampledDirections(const EnvironmentImage& image, By by = By::radiance) {
    const auto [emitter, words] = sampledBy(image, by);
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

// Karlik et al. 2019: directions in proportion to what exceeds the mean; to none in particular where nothing does.
TEST(EnvmapSampling, DirectionsMayFollowWhatExceedsTheMean) {
    for (const auto& [name, image] : images()) {
        const auto directions = sampledDirections(image, By::whatExceedsTheMean);
        EXPECT_GT(fit(image, directions, image, By::whatExceedsTheMean), significanceLevel(statisticalTests)) << name;
        if (std::string(name) != "gradient") continue;
        EXPECT_LT(fit(image, directions, image), significanceLevel(statisticalTests)) << "negative control";
    }
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

} // namespace
} // namespace quasilux
