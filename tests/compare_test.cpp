// Measures of `quasilux compare` on images whose errors are known by hand.
#include "compare/error_picture.h"
#include "compare/measures.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace quasilux {
namespace {

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

using Rgb = std::array<float, 3>;

RadianceImage uniform(unsigned width, unsigned height, const Rgb& rgb) {
    RadianceImage image{"image", width, height, {}, {}, {}};
    for (size_t i = 0; i < image.pixels(); ++i) image.radiance.insert(image.radiance.end(), rgb.begin(), rgb.end());
    return image;
}

RadianceImage withNoise(RadianceImage image, float standardError) {
    image.standardError.assign(image.radiance.size(), standardError);
    return image;
}

RegionMeasures measureAll(const RadianceImage& image, const RadianceImage& reference,
                          const CompareSettings& settings = {}) {
    return compareImages(image, reference, {wholePicture(image.width, image.height)}, settings).regions.at(0);
}

Region rows(const std::string& name, unsigned width, unsigned first, unsigned end) {
    Region region{name, {}};
    for (size_t pixel = size_t{first} * width; pixel < size_t{end} * width; ++pixel) region.pixels.push_back(pixel);
    return region;
}

TEST(Compare, EqualImagesHaveNoError) {
    const auto image = uniform(8, 4, {1, 2, 3});
    const auto result = measureAll(image, image);
    EXPECT_EQ(result.relMse, 0);
    EXPECT_EQ(result.rmse, 0);
    EXPECT_EQ(result.bias, 0);
    EXPECT_EQ(result.standardErrorByTiles, 0);
    EXPECT_FALSE(result.standardErrorByPixels);
    EXPECT_FALSE(result.referenceNoise);
}

TEST(Compare, EachChannelCountsWithItsOwnReference) {
    // mean(R) = 2, so the floor is 0.04.
    const auto result = measureAll(uniform(8, 4, {1.5f, 1, 3}), uniform(8, 4, {1, 2, 3}));
    EXPECT_NEAR(result.relMse, (0.25 / 1.04 + 1 / 4.04) / 3, 1e-12);
    EXPECT_NEAR(result.rmse, std::sqrt(1.25 / 3), 1e-12);
    EXPECT_NEAR(result.bias, 0.2126 * 0.5 - 0.7152, 1e-12);
    EXPECT_NEAR(result.relativeBias(), (0.2126 * 0.5 - 0.7152) / (0.2126 + 2 * 0.7152 + 3 * 0.0722), 1e-12);
    EXPECT_THAT(result.meanImage, testing::ElementsAre(1.5, 1, 3));
    EXPECT_THAT(result.meanReference, testing::ElementsAre(1, 2, 3));
}

TEST(Compare, FloorIsOfTheWholePictureInEveryRegion) {
    // Upper half 1, lower half 3: mean(R) = 2 in both regions, whereas their own means are 1 and 3.
    auto reference = uniform(4, 4, {1, 1, 1});
    std::fill(reference.radiance.begin() + 24, reference.radiance.end(), 3.0f);
    auto image = reference;
    for (float& value : image.radiance) value += 0.5f;
    const auto result = compareImages(image, reference, {rows("upper", 4, 0, 2), rows("lower", 4, 2, 4)}, {});
    EXPECT_NEAR(result.regions[0].relMse, 0.25 / 1.04, 1e-12);
    EXPECT_NEAR(result.regions[1].relMse, 0.25 / 9.04, 1e-12);
    EXPECT_NEAR(result.regions[0].relativeBias(), 0.5, 1e-12);
    EXPECT_NEAR(result.regions[1].relativeBias(), 0.5 / 3, 1e-12);
}

TEST(Compare, BlackReferenceHasNoScale) {
    const auto black = uniform(2, 2, {0, 0, 0});
    EXPECT_EQ(measureAll(black, black).relMse, 0);
    EXPECT_EQ(measureAll(uniform(2, 2, {1, 0, 0}), black).relMse, std::numeric_limits<double>::infinity());
}

TEST(Compare, NoiseIsSubtractedWhereItIsKnown) {
    const auto image = withNoise(uniform(4, 4, {2.5f, 2.5f, 2.5f}), 0.25f);
    const auto reference = withNoise(uniform(4, 4, {2, 2, 2}), 0.125f);
    const auto net = measureAll(image, reference);
    EXPECT_NEAR(net.relMse, 0.25 / 4.04, 1e-12);
    EXPECT_NEAR(*net.referenceNoise, 0.015625 / 4.04, 1e-12);
    EXPECT_NEAR(*net.imageNoise, 0.0625 / 4.04, 1e-12);
    EXPECT_NEAR(net.netRelMse, (0.25 - 0.015625) / 4.04, 1e-12);
    const auto both = measureAll(image, reference, {.referenceNoise = {}, .netOfImageNoise = true});
    EXPECT_NEAR(both.netRelMse, (0.25 - 0.015625 - 0.0625) / 4.04, 1e-12);
}

// A right image against a noisy reference: net relMSE should be 0. Values of noise 0.1: sqrt(2) 0.01 / sqrt(49152) is
// one standard error; the fixed seed would fail at 4 of them once in 16000.
TEST(Compare, NoiseInTheDenominatorsIsToldAndAvoided) {
    constexpr float noise = 0.1f;
    const auto truth = uniform(128, 128, {1, 1, 1});
    auto reference = withNoise(truth, noise);
    std::mt19937 generator(3);
    std::normal_distribution<float> normal(0, noise);
    for (float& value : reference.radiance) value += normal(generator);
    const double standardError = std::sqrt(2.0 / static_cast<double>(truth.radiance.size())) * noise * noise;

    const auto own = measureAll(truth, reference);
    EXPECT_GT(own.netRelMse, 4 * standardError) << "R itself in the denominators must be seen to bias";
    EXPECT_NEAR(own.netRelMse, *own.denominatorNoise, 4 * standardError);
    CompareSettings settings;
    settings.scale = &truth;
    const auto scaled = measureAll(truth, reference, settings);
    EXPECT_NEAR(scaled.netRelMse, 0, 4 * standardError);
    EXPECT_FALSE(scaled.denominatorNoise);
}

TEST(Compare, StatedNoiseStandsInForStandardErrors) {
    const auto image = uniform(4, 4, {2.5f, 2.5f, 2.5f}), reference = uniform(4, 4, {2, 2, 2});
    const CompareSettings settings{.referenceNoise = {{"", 0.001}, {"upper", 0.002}}};
    const std::vector<Region> regions{rows("upper", 4, 0, 2), rows("lower", 4, 2, 4)};
    const auto stated = compareImages(image, reference, regions, settings);
    EXPECT_EQ(stated.regions[0].referenceNoise, 0.002);
    EXPECT_EQ(stated.regions[1].referenceNoise, 0.001);
    EXPECT_NEAR(stated.regions[0].netRelMse, 0.25 / 4.04 - 0.002, 1e-12);
    EXPECT_EQ(compareImages(image, withNoise(reference, 0), regions, settings).regions[0].referenceNoise, 0)
        << "standard errors of the reference come first";
}

TEST(Compare, StandardErrorOfIndependentPixels) {
    const auto reference = withNoise(uniform(8, 8, {2, 2, 2}), 0.4f);
    const auto result = measureAll(withNoise(uniform(8, 8, {2, 2, 2}), 0.3f), reference);
    EXPECT_NEAR(*result.standardErrorByPixels, 0.5 / 8, 1e-7);
    EXPECT_NEAR(*result.standardError(), 0.5 / 8, 1e-7);
}

TEST(Compare, StandardErrorByTilesOfAKnownPattern) {
    // 16 tiles of 2 x 2 pixels, in turn 1 above and 1 below: each excess is 4.
    const auto reference = uniform(8, 8, {2, 2, 2});
    auto image = reference;
    for (size_t i = 0; i < image.radiance.size(); ++i)
        image.radiance[i] += (i / 3 % 8 / 2 + i / 3 / 16) % 2 == 0 ? 1.0f : -1.0f;
    const auto result = measureAll(image, reference);
    EXPECT_NEAR(result.bias, 0, 1e-12);
    EXPECT_NEAR(*result.standardErrorByTiles, std::sqrt(16 * 16 * 16 / 15.0) / 64, 1e-12);
    // One tile alone says nothing of how tiles vary.
    EXPECT_FALSE(compareImages(image, reference, {{"tile", {0, 1, 8, 9}}}, {}).regions[0].standardErrorByTiles);
}

/// Mean square of an estimated standard error over trials where the pixels of each tile share their noise, relative to
/// the true one.
double meanSquaredRatio(std::optional<double> RegionMeasures::*estimate) {
    constexpr unsigned trials = 400, side = 16;
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    const auto reference = uniform(side, side, {5, 5, 5});
    double sum = 0;
    for (unsigned trial = 0; trial < trials; ++trial) {
        auto image = withNoise(reference, 1);
        std::array<float, 16> shared{};
        for (float& value : shared) value = normal(random);
        for (size_t i = 0; i < image.radiance.size(); ++i)
            image.radiance[i] += shared[i / 3 % side / 4 + i / 3 / side / 4 * 4];
        const double error = (measureAll(image, reference).*estimate).value();
        sum += error * error / (1 / 16.0); // the mean of 16 independent draws
    }
    return sum / trials;
}

TEST(Compare, TilesKnowNoiseThatNeighboursShare) {
    // The mean of 400 chi-squared variables of 15 degrees of freedom: a false alarm, beyond 4 of its standard errors,
    // has a probability of 6e-5.
    const double tolerance = 4 * std::sqrt(2.0 / 15 / 400);
    EXPECT_NEAR(meanSquaredRatio(&RegionMeasures::standardErrorByTiles), 1, tolerance);
    // Control: pixels taken as independent do not know it.
    EXPECT_LT(meanSquaredRatio(&RegionMeasures::standardErrorByPixels), 1 - tolerance);
}

TEST(Compare, PixelsThatAreNotFiniteSpoilWhatTheyArePartOf) {
    const auto reference = uniform(4, 4, {2, 2, 2});
    auto image = uniform(4, 4, {2.5f, 2.5f, 2.5f});
    image.radiance[3 * 5 + 1] = notANumber;
    image.radiance[3 * 6] = infinite;
    const std::vector<Region> regions{rows("upper", 4, 0, 2), rows("lower", 4, 2, 4)};
    const auto result = compareImages(image, reference, regions, {.maximumNonFinite = 1, .worstPixels = 3});
    EXPECT_EQ(result.nonFiniteImage, 2u);
    EXPECT_EQ(result.nonFiniteReference, 0u);
    EXPECT_THAT(result.nonFinitePixels, testing::ElementsAre(5, 6));
    EXPECT_FALSE(result.nonFiniteLeftOut);
    EXPECT_EQ(result.regions[0].nonFinite, 2u);
    EXPECT_EQ(result.regions[1].nonFinite, 0u);
    EXPECT_TRUE(std::isnan(result.regions[0].relMse));
    EXPECT_TRUE(std::isnan(result.regions[0].netRelMse));
    EXPECT_TRUE(std::isnan(result.regions[0].rmse));
    EXPECT_TRUE(std::isnan(result.regions[0].bias));
    EXPECT_NEAR(result.regions[1].relMse, 0.25 / 4.04, 1e-12);
    ASSERT_EQ(result.worst.size(), 3u);
    EXPECT_EQ(result.worst[0].x + 4 * result.worst[0].y, 5u);
    EXPECT_EQ(result.worst[1].x + 4 * result.worst[1].y, 6u);
    EXPECT_TRUE(std::isinf(result.worst[0].relativeSquare));
}

TEST(Compare, FewPixelsThatAreNotFiniteAreLeftOutOnDemandAndCounted) {
    auto reference = uniform(4, 4, {2, 2, 2});
    reference.radiance[3 * 9] = infinite;
    auto image = uniform(4, 4, {2.5f, 2.5f, 2.5f});
    EXPECT_FALSE(std::isfinite(compareImages(image, reference, {rows("upper", 4, 0, 2)}, {}).regions[0].relMse))
        << "mean(R) is part of every relMSE";
    const auto result = compareImages(image, reference, {wholePicture(4, 4)}, {.maximumNonFinite = 1});
    EXPECT_TRUE(result.nonFiniteLeftOut);
    EXPECT_EQ(result.nonFiniteReference, 1u);
    EXPECT_EQ(result.regions[0].nonFinite, 1u);
    EXPECT_EQ(result.regions[0].pixels, 16u);
    EXPECT_NEAR(result.regions[0].relMse, 0.25 / 4.04, 1e-12);
    EXPECT_NEAR(result.regions[0].bias, 0.5, 1e-12);
    image.standardError.assign(image.radiance.size(), 1.f);
    reference.standardError = image.standardError;
    EXPECT_EQ(compareImages(image, reference, {wholePicture(4, 4)}, {.maximumNonFinite = 1}).beyondThreeStandardErrors,
              0)
        << "left out there, too";
}

TEST(Compare, WorstPixelsHavePlaceValuesAndStandardErrors) {
    const auto reference = withNoise(uniform(8, 4, {2, 2, 2}), 0.3f);
    auto image = withNoise(reference, 0.4f);
    image.radiance[3 * (2 * 8 + 3) + 2] = 1;    // at 3, 2
    image.radiance[3 * (1 * 8 + 6) + 0] = 4.5f; // at 6, 1
    const auto result = compareImages(image, reference, {wholePicture(8, 4)}, {.worstPixels = 2});
    ASSERT_EQ(result.worst.size(), 2u);
    EXPECT_EQ(result.worst[0].x, 6u);
    EXPECT_EQ(result.worst[0].y, 1u);
    EXPECT_THAT(result.worst[0].image, testing::ElementsAre(4.5f, 2, 2));
    EXPECT_THAT(result.worst[0].reference, testing::ElementsAre(2, 2, 2));
    EXPECT_NEAR(result.worst[0].relativeSquare, 6.25 / 3 / 4.04, 1e-12);
    EXPECT_NEAR(*result.worst[0].standardErrors, 5, 1e-5);
    EXPECT_EQ(result.worst[1].x, 3u);
    EXPECT_EQ(result.worst[1].y, 2u);
    EXPECT_NEAR(*result.worst[1].standardErrors, -2, 1e-5);
    EXPECT_NEAR(*result.beyondThreeStandardErrors, 1 / 96.0, 1e-12);
}

TEST(Compare, ErrorPicturesShowSignAndSize) {
    const auto reference = withNoise(uniform(4, 1, {2, 2, 2}), 0.1f);
    auto image = uniform(4, 1, {2, 2, 2});
    const std::array<float, 4> values{2, 4, 0, notANumber};
    for (size_t i = 0; i < 12; ++i) image.radiance[i] = values[i / 3];
    const auto comparison = compareImages(image, reference, {wholePicture(4, 1)}, {.maximumNonFinite = 1});
    const Picture expected{255, 255, 255, 204, 0, 0, 0, 0, 204, 255, 0, 255};
    EXPECT_EQ(signedPicture(image, reference), expected);
    EXPECT_EQ(standardErrorPicture(image, reference), expected);
    EXPECT_TRUE(standardErrorPicture(image, uniform(4, 1, {2, 2, 2})).empty());
    const Picture squares = squarePicture(comparison); // 4 / 4.04 is next to white
    EXPECT_THAT(std::vector(squares.begin(), squares.begin() + 5), testing::ElementsAre(0, 0, 0, 255, 255));
    EXPECT_THAT(std::vector(squares.begin() + 9, squares.end()), testing::ElementsAre(255, 0, 255));
}

std::vector<unsigned char> decodeBase64(const std::string& text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    unsigned group = 0, bits = 0;
    for (const char c : text.substr(0, text.find('='))) {
        group = group << 6u | static_cast<unsigned>(digits.find(c));
        bits += 6;
        if (bits >= 8) bytes.push_back(static_cast<unsigned char>(group >> (bits -= 8) & 255u));
    }
    return bytes;
}

TEST(Compare, SharedExponentsKeepRadianceThroughThePng) {
    auto image = uniform(5, 2, {0, 0, 0});
    std::mt19937 random(3);
    for (size_t i = 0; i < 24; ++i) image.radiance[i] = std::exp2(std::uniform_real_distribution<float>(-9, 9)(random));
    image.radiance[27] = infinite; // pixel 8 stays black, pixel 9 is not finite
    const std::string uri = pngDataUri(sharedExponentPicture(image), 5, 4), prefix = "data:image/png;base64,";
    ASSERT_EQ(uri.substr(0, prefix.size()), prefix);
    auto bytes = decodeBase64(uri.substr(prefix.size()));
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto input = OIIO::ImageInput::open("picture.png", nullptr, &memory);
    ASSERT_TRUE(input);
    ASSERT_EQ(input->spec().nchannels, 3);
    ASSERT_EQ(input->spec().height, 4);
    Picture picture(60);
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, picture.data()));
    for (size_t i = 0; i < 27; ++i) {
        const float* rgb = &image.radiance[i / 3 * 3];
        const double largest = std::max({rgb[0], rgb[1], rgb[2]});
        EXPECT_NEAR(std::ldexp(picture[i], picture[30 + i] - 136), image.radiance[i], largest / 128) << i;
    }
    EXPECT_EQ(picture[57], 255);
}

} // namespace
} // namespace quasilux
