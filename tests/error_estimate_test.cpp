// From standard errors and bias by pixel to the figures of a render: definitions, and that few passes do not skew them.
//
// Noise is drawn with fixed seeds. Over 20,000 independent pixels the figures compared scatter by 1 % or less, and by
// a tenth of biasNoiseRms, so the tolerances are 3 standard deviations or more: a right rule fails with probability
// below 1 %.
#include "render/error_estimate.h"

#include "support/film_images.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

/// After so many passes that none of the corrections for few matters.
FilmImage noiselessImage(unsigned width, unsigned height, float value) {
    return uniformImage(width, height, value, 1000, 0);
}

TEST(ErrorEstimate, IsRelativeToTheValueWithAFloor) {
    FilmImage image = noiselessImage(10, 2, 2.f);
    image.standardError.assign(60, 0.5f);
    const double scale = std::sqrt(4 + 0.01 * 4);
    EXPECT_NEAR(estimateError(image).total.noiseRms, 0.5 / scale, 1e-6);
    EXPECT_NEAR(estimateError(image).total.noiseMean, 0.5 / scale, 1e-3 * 0.5);
    EXPECT_NEAR(estimateError(image).total.noisePercentile95, 0.5 / scale, 1e-3 * 0.5);
    // The left half black: the mean is 1, so four columns are divided by 0.1, the next by the mean over 3 x 3 pixels.
    for (size_t k = 0; k < image.radiance.size(); ++k)
        if (k / 3 % 10 < 5) image.radiance[k] = 0;
    const double sum =
        4 * 0.5 / 0.1 + 0.5 / std::hypot(2.0 / 3, 0.1) + 0.5 / std::hypot(4.0 / 3, 0.1) + 4 * 0.5 / std::hypot(2, 0.1);
    EXPECT_NEAR(estimateError(image).total.noiseMean, 2 * sum / 20, 1e-3 * sum);
    EXPECT_NEAR(estimateError(image).total.noisePercentile95, 5, 0.05);
    // One channel of three.
    image = noiselessImage(1, 1, 1.f);
    image.standardError = {0, 0.1f, 0};
    EXPECT_NEAR(estimateError(image).total.noiseRms, 0.1 / std::sqrt(3 * 1.01), 1e-6);
}

TEST(ErrorEstimate, KnowsWhatItDoesNotKnow) {
    FilmImage image = noiselessImage(2, 2, 1.f);
    image.batches = 1;
    EXPECT_EQ(estimateError(image).sum(), INFINITY); // so that no error limit counts as reached
    EXPECT_EQ(estimateError(noiselessImage(2, 2, 0.f)).sum(), 0);
    EXPECT_FALSE(estimateError(image).hasBias);
}

// Pixels of relative noise `deviation[pixel]` per pass, rendered in so many passes; bias `bias` everywhere, of which
// each pass estimates with three times the noise of the image.
FilmImage simulate(const std::vector<double>& deviation, unsigned passes, double bias, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    FilmImage image = noiselessImage(unsigned(deviation.size()), 1, 1.f);
    image.passes = image.batches = passes;
    image.bias.resize(image.radiance.size());
    image.biasError.resize(image.radiance.size());
    for (size_t pixel = 0; pixel < deviation.size(); ++pixel) {
        double squares = 0, mean = 0, biasSquares = 0, biasMean = 0;
        for (unsigned k = 0; k < passes; ++k) {
            const double x = deviation[pixel] * normal(random), y = bias + 3 * deviation[pixel] * normal(random);
            mean += x / passes;
            squares += x * x;
            biasMean += y / passes;
            biasSquares += y * y;
        }
        const double n = passes;
        for (size_t c = 0; c < 3; ++c) {
            image.standardError[3 * pixel + c] = float(std::sqrt((squares - n * mean * mean) / (n * (n - 1))));
            image.bias[3 * pixel + c] = float(biasMean);
            image.biasError[3 * pixel + c] = float(std::sqrt((biasSquares - n * biasMean * biasMean) / (n * (n - 1))));
        }
    }
    return image;
}

struct Truth {
    double mean = 0, percentile95 = 0, rms = 0;
};

// Relative noise of a pass between 0.04 and 0.25 or so, in 20,000 pixels.
std::vector<double> unevenNoise() {
    std::mt19937 random(7);
    std::lognormal_distribution<double> spread(std::log(0.1), 0.3);
    std::vector<double> deviation(20'000);
    for (double& d : deviation) d = spread(random);
    return deviation;
}

Truth truthOf(std::vector<double> deviation, unsigned passes) {
    const double scale = std::sqrt(1.01 * passes);
    Truth truth;
    for (double& d : deviation) {
        d /= scale;
        truth.mean += d / double(deviation.size());
        truth.rms += d * d / double(deviation.size());
    }
    truth.rms = std::sqrt(truth.rms);
    std::sort(deviation.begin(), deviation.end());
    truth.percentile95 = deviation[deviation.size() * 95 / 100];
    return truth;
}

class Passes : public testing::TestWithParam<unsigned> {};
TEST_P(Passes, FewOfThemDoNotSkewTheNoise) {
    const auto deviation = unevenNoise();
    const Truth truth = truthOf(deviation, GetParam());
    const ErrorPart found = estimateError(simulate(deviation, GetParam(), 0, 1)).total;
    EXPECT_NEAR(found.noiseMean / truth.mean, 1, 0.02);
    // Drawing logarithms together cannot undo their skew: 5 % are left after four passes.
    EXPECT_NEAR(found.noisePercentile95 / truth.percentile95, 1, 0.08);
    EXPECT_NEAR(found.noiseRms / truth.rms, 1, 0.04);
}

TEST_P(Passes, NoiseIsNoBias) {
    const auto deviation = unevenNoise();
    const double noise = estimateError(simulate(deviation, GetParam(), 0, 2)).total.biasNoiseRms;
    EXPECT_NEAR(noise, 3 * truthOf(deviation, GetParam()).rms, 0.05 * noise);
    EXPECT_LT(estimateError(simulate(deviation, GetParam(), 0, 2)).total.biasRms, 0.25 * noise);
    // A bias half as large as the noise of its estimate is found.
    const double bias = estimateError(simulate(deviation, GetParam(), 0.5 * noise, 3)).total.biasRms;
    EXPECT_NEAR(bias * std::sqrt(1.01) / (0.5 * noise), 1, 0.15);
}
INSTANTIATE_TEST_SUITE_P(Counts, Passes, testing::Values(4u, 16u, 64u));

// Controls: what plain averages of the pixels' standard errors would say after four passes.
TEST(ErrorEstimate, PlainAveragesWouldBeWrong) {
    const auto deviation = unevenNoise();
    const Truth truth = truthOf(deviation, 4);
    const FilmImage image = simulate(deviation, 4, 0, 1);
    std::vector<double> plain(deviation.size());
    double mean = 0;
    for (size_t k = 0; k < plain.size(); ++k) {
        plain[k] = image.standardError[3 * k] / std::sqrt(1.01);
        mean += plain[k] / double(plain.size());
    }
    std::sort(plain.begin(), plain.end());
    EXPECT_LT(mean / truth.mean, 0.95);
    EXPECT_GT(plain[plain.size() * 95 / 100] / truth.percentile95, 1.08);
}

} // namespace
} // namespace quasilux
