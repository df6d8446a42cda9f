// The choice of settings by pilot passes (docs/auto.md): prediction, and the mean of what is added. The search: search_test.cpp.
//
// False alarms: the mean is held to 4 standard errors (6e-5); the seeds are fixed.
#include "auto/auto_render.h"
#include "auto/combination.h"
#include "support/even_pilot.h"
#include "support/render_statistics.h"

#include "device/device.h"
#include "render/radius.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

// --- prediction ---

// Bias as the radius to the power of 1.4, so its square as the squared radius to that power.
TEST(Prediction, NoiseFallsWithPassesAndBiasWithTheMeanSquaredRadius) {
    const PilotMeasure pilot = evenPilot(4, 8, 0.5, 0.1);
    const auto meanSquare = [](unsigned passes) {
        double sum = 0;
        for (unsigned i = 0; i < passes; ++i) sum += radiusShrink(i) * radiusShrink(i);
        return sum / passes;
    };
    for (const unsigned passes : {4u, 40u, 400u}) {
        const Prediction predicted = predictAfterPasses(pilot, passes);
        EXPECT_NEAR(predicted.noise, 8.0 / passes, 1e-9);
        const double blur = meanSquare(passes) / meanSquare(4);
        // Radii far on are taken in steps.
        EXPECT_NEAR(predicted.bias / (0.5 * std::pow(blur, 1.4)), 1, 0.005) << passes;
    }
    EXPECT_NEAR(predictAfter(pilot, 1).passes, 14, 1e-9);
}

// A bias that cannot be told from none may be there: the candidate that knows less about it is not the better one for that.
TEST(Prediction, BiasIsAtLeastWhatItsNoiseMayHide) {
    PilotMeasure pilot = evenPilot(4, 8, 0.01, 0.1);
    EXPECT_NEAR(predictAfterPasses(pilot, 4).bias, 0.01, 1e-9); // control: known well
    pilot.biasNoise = 5;
    EXPECT_NEAR(predictAfterPasses(pilot, 4).bias, 5.0 / 25, 1e-9);
    pilot.bias.assign(pilot.bias.size(), -0.01); // net of noise
    EXPECT_NEAR(predictAfterPasses(pilot, 4).bias, 5.0 / 25, 1e-9);
}

// Of small images the tiles' scatter hides more than that: as many below 0 as above are no bias at all.
TEST(Prediction, BiasIsAtLeastWhatItsTilesMayHide) {
    PilotMeasure pilot = evenPilot(4, 8, 0.64, 0.1);
    EXPECT_TRUE(tellsBias(pilot)); // control: even
    for (size_t tile = 0; tile < pilot.bias.size(); tile += 2) pilot.bias[tile] *= -1;
    EXPECT_FALSE(tellsBias(pilot));
    EXPECT_NEAR(predictAfterPasses(pilot, 4).bias, 0.08, 0.001); // 0.01 times the root of 64 tiles
}

// What shrinks with the discs makes late passes cheaper. Control: what does not.
TEST(Prediction, PassesGrowCheaperAsDiscsShrink) {
    PilotMeasure pilot = evenPilot(16, 8, 0, 0.1);
    EXPECT_NEAR(predictAfter(pilot, 100).passes, 1016, 1e-6);
    pilot.secondsWithRadius = 0.06;
    double seconds = 0;
    for (unsigned pass = 16; pass < 1016; ++pass)
        seconds += 0.04 + 0.06 * std::pow(radiusShrink(pass) / radiusShrink(12), 2); // the middle of passes 8 to 16
    EXPECT_LT(seconds, 70);
    EXPECT_NEAR(predictAfter(pilot, seconds).passes, 1016, 1);
}

TEST(Prediction, TimeToAnErrorIsWhereThePredictionMeetsIt) {
    const PilotMeasure pilot = evenPilot(4, 1, 0, 0.5);
    const double seconds = secondsToError(pilot, 0.1, 1000); // 100 passes, 4 of them done
    EXPECT_NEAR(seconds, 48, 1e-6);
    EXPECT_EQ(secondsToError(pilot, 0.001, 1000), 1000);
}

// What is hard for both is no uncertainty of their ratio; a bright pixel of one of them is.
TEST(Prediction, RatioIsUncertainWhereOneTileHoldsTheNoiseOfOne) {
    PilotMeasure a = evenPilot(4, 1, 0, 1), b = evenPilot(4, 2, 0, 1);
    a.noise[0] = b.noise[0] * 10;
    b.noise[0] = a.noise[0] * 2;
    const ErrorRatio same = errorRatio(a, b, 100);
    EXPECT_NEAR(same.logRatio, std::log(0.5), 1e-6);
    EXPECT_LT(same.standardError, 1e-6);
    b.noise[0] = 100 * b.noise[1];
    EXPECT_GT(errorRatio(a, b, 100).standardError, 0.3);
}

void addScatter(PilotMeasure& pilot) {
    for (size_t tile = 0; tile < pilot.bias.size(); ++tile) pilot.bias[tile] += tile % 2 ? 0.02 : -0.02;
}
constexpr double scatterOfSum = 0.16; // of 64 tiles

// Biases that noise hides say nothing for either, nor that one radius is better. Controls: biases that are told.
TEST(Prediction, BiasesThatAreNotToldApartAreOne) {
    PilotMeasure a = evenPilot(4, 1, 0.2, 1), b = evenPilot(4, 1, 0.3, 1);
    EXPECT_LT(errorRatio(a, b, 0).logRatio, -0.1);
    for (auto* pilot : {&a, &b}) addScatter(*pilot);
    EXPECT_NEAR(errorRatio(a, b, 0).logRatio, 0, 1e-9);
    EXPECT_LT(errorRatio(a, b, 0).standardError, 1e-6);
    b.radius = std::sqrt(2.0);
    // So many times the bias is expected of it, so it tells a's with that much less noise.
    const double more = std::pow(2.0, 1.4);
    const double ofA = (0.2 + more * 0.3) / (1 + more * more);
    EXPECT_NEAR(errorRatio(a, b, 0).logRatio, std::log((0.25 + ofA) / (0.25 + more * ofA)), 1e-3);
}

// Of a difference of two standard errors three quarters count. Controls: all of what is told surely; nothing below one.
TEST(Prediction, BiasesCountApartAsFarAsNoiseDoesNotExplainIt) {
    const auto logRatio = [](double standardErrors, bool isSure) {
        const double apart = standardErrors * std::sqrt(2.0) * scatterOfSum;
        PilotMeasure a = evenPilot(4, 1, 0.3, 1), b = evenPilot(4, 1, 0.3 + apart, 1);
        if (!isSure)
            for (auto* pilot : {&a, &b}) addScatter(*pilot);
        return errorRatio(a, b, 0).logRatio;
    };
    const double mean = 0.3 + std::sqrt(2.0) * scatterOfSum, kept = 0.75 * (mean - 0.3);
    // Standard errors are those of a sample of 64, n / (n - 1) in their square.
    EXPECT_NEAR(logRatio(2, false), std::log((0.25 + mean - kept) / (0.25 + mean + kept)), 0.01);
    EXPECT_NEAR(logRatio(2, true), std::log(0.55 / (0.25 + 2 * mean - 0.3)), 1e-9);
    EXPECT_NEAR(logRatio(0.9, false), 0, 1e-9);
}

// From 8 passes of a render what 64 tell: within 30 % of the square, 15 % of the error, since 8 passes know no better;
// the seed is fixed. One radius for all: radii by pixel, chosen in these passes, lower the noise later (docs/auto.md). Negative control: were noise not divided by passes, it would be 8 times too much.
TEST(Prediction, HoldsInARender) {
    Device device(0);
    RenderSettings settings;
    settings.photonsPerPass = 20'000;
    settings.radius = RadiusChoice::fixed;
    const Scene scene = projectScene("cornell_phong.xml", {{"resolution", "32"}});
    Renderer renderer(device, scene, settings);
    for (unsigned pass = 0; pass < 8; ++pass) renderer.renderPass(pass);
    const PilotMeasure pilot = measurePilot(renderer.develop(), false, 1);
    for (unsigned pass = 8; pass < 64; ++pass) renderer.renderPass(pass);
    const ErrorEstimate told = estimateError(renderer.develop());
    const double noise = told.total.noiseRms * told.total.noiseRms;
    EXPECT_NEAR(predictAfterPasses(pilot, 64).noise / noise, 1, 0.3);
    EXPECT_GT(predictAfterPasses(pilot, 8).noise / noise, 2);
}

// --- images as one ---

TEST(Combination, WeightsAreInverseToTheErrorAndSmallOnesAreLeftOut) {
    const auto weights = combinationWeights({{2, 1}, {1e6, 1}, {1, 1}});
    EXPECT_NEAR(weights[0], 1.0 / 3, 1e-12);
    EXPECT_EQ(weights[1], 0);
    EXPECT_NEAR(weights[2], 2.0 / 3, 1e-12);
    EXPECT_EQ(combinationWeights({{INFINITY, 1}, {INFINITY, 1}}), (std::vector<double>{0, 1}));
    // Few passes that tell of little error weigh as their time.
    EXPECT_NEAR(combinationWeights({{0.1, 1}, {1, 9}})[0], 0.1, 1e-12);
}

FilmImage syntheticImage(unsigned pixels, double mean, double deviation, std::mt19937& random) {
    FilmImage image;
    image.width = pixels;
    image.height = 1;
    image.passes = 8;
    std::normal_distribution<float> noise(static_cast<float>(mean), static_cast<float>(deviation));
    for (unsigned k = 0; k < 3 * pixels; ++k) image.radiance.push_back(noise(random));
    image.standardError.assign(3 * pixels, static_cast<float>(deviation));
    return image;
}

// Squared deviations over told variances: chi-squared of 60,000 values, 4.5 standard deviations (7e-6) either way.
// Negative control: weights that are not squared tell another variance.
TEST(Combination, ToldErrorIsTheScatter) {
    std::mt19937 random(1);
    const unsigned pixels = 20'000;
    const std::vector<FilmImage> images{syntheticImage(pixels, 5, 1, random), syntheticImage(pixels, 5, 0.5, random)};
    const std::vector<double> weights{0.2, 0.8};
    const FilmImage sum = combineImages(images, weights);
    double squares = 0;
    for (size_t k = 0; k < sum.radiance.size(); ++k)
        squares += std::pow((sum.radiance[k] - 5) / sum.standardError[k], 2);
    const double n = 3.0 * pixels, bound = 4.5 * std::sqrt(2 / n);
    EXPECT_NEAR(squares / n, 1, bound);
    const double unsquared = 0.2 * 1 + 0.8 * 0.25, right = 0.04 * 1 + 0.64 * 0.25;
    EXPECT_GT(std::abs(squares / n * right / unsquared - 1), bound);
    EXPECT_EQ(sum.passes, 16u);
}

// --- the mean does not depend on the choice ---

// scenes/furnace_split.xml has radiance 2.5 everywhere, for every setting.
class CostedPilot : public RendererPilot {
public:
    CostedPilot(Device& device, const Scene& scene, const RenderSettings& settings, double& clock)
        : RendererPilot(device, std::make_unique<Renderer>(device, scene, settings), false), clock_(clock) {}
    void renderPass() override {
        RendererPilot::renderPass();
        clock_ += 0.1;
    }
    PilotMeasure measure() const override {
        PilotMeasure pilot = RendererPilot::measure();
        pilot.secondsPerPass = 0.1;
        pilot.secondsWithRadius = 0;
        pilot.photonShare = 0.5;
        return pilot;
    }
    double openingSeconds() const override { return 0; }

private:
    double& clock_;
};

double meanOf(const FilmImage& image) {
    double sum = 0;
    for (const float value : image.radiance) sum += value;
    return sum / static_cast<double>(image.radiance.size());
}

// The images that a search with this seed leaves, the chosen one last; 8 s of 0.1 s a pass.
struct Searched {
    std::vector<FilmImage> images;
    std::vector<double> seconds;
};
Searched searchedImages(Device& device, const Scene& scene, uint64_t seed) {
    double clock = 0;
    SearchWorld world;
    world.open = [&](const RenderSettings& settings) {
        return std::make_unique<CostedPilot>(device, scene, settings, clock);
    };
    world.clock = [&] { return clock; };
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    settings.seed = seed;
    StopRule stop;
    stop.seconds = 8;
    auto result = Search(world, scene, {true, true, true, false, false}, stop).run(settings, world.open(settings));
    while (clock < 4) result.best->renderPass();
    result.others.push_back(result.best->image());
    result.othersSeconds.push_back(0.1 * result.best->passes());
    return {std::move(result.others), std::move(result.othersSeconds)};
}

struct Means {
    std::vector<double> values;

    double z(double truth) const {
        double sum = 0, squares = 0;
        for (const double v : values) sum += v;
        const double n = static_cast<double>(values.size()), mean = sum / n;
        for (const double v : values) squares += (v - mean) * (v - mean);
        return (mean - truth) / std::sqrt(squares / (n * (n - 1)));
    }
};

FilmImage weightedByPixel(const std::vector<FilmImage>& images) {
    FilmImage sum = images.back();
    for (size_t k = 0; k < sum.radiance.size(); ++k) {
        double weights = 0, value = 0;
        for (const auto& image : images) {
            const double weight = 1 / (1e-12 + std::pow(image.standardError[k], 2));
            weights += weight;
            value += weight * image.radiance[k];
        }
        sum.radiance[k] = static_cast<float>(value / weights);
    }
    return sum;
}

TEST(AutoMean, IsThatOfAnyFixedChoice) {
    Device device(0);
    const Scene scene = projectScene("furnace_split.xml", {{"resolution", "12"}});
    Means combined, byPixel, darker;
    size_t added = 0;
    for (uint64_t seed = 1; seed <= 96; ++seed) {
        const auto [images, seconds] = searchedImages(device, scene, seed);
        added += images.size() - 1;
        combined.values.push_back(meanOf(combineImages(images, weightsByError(images, seconds))));
        byPixel.values.push_back(meanOf(weightedByPixel(images)));
        double dark = INFINITY;
        for (const auto& image : images) dark = std::min(dark, meanOf(image));
        darker.values.push_back(dark);
    }
    EXPECT_GT(added, 96u) << "nothing was added that could change the mean";
    EXPECT_LT(std::abs(combined.z(2.5)), 4);
    // Negative controls: weights by the pixel's own variance, or keeping the darkest image, are seen. The former brighten
    // here, and darken where bright pixels are the noisier ones.
    EXPECT_GT(byPixel.z(2.5), 4);
    EXPECT_LT(darker.z(2.5), -4);
}

} // namespace
} // namespace quasilux
