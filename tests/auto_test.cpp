// The choice of settings by pilot passes (docs/method/auto.md): prediction, and the image of the choice. The search:
// search_test.cpp.
#include "auto/auto_render.h"
#include "support/even_pilot.h"
#include "support/render_statistics.h"

#include "device/device.h"
#include "render/radius.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

// A bias that cannot be distinguished from none may be there: the candidate that knows less about it is not the better
// one for that.
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
    EXPECT_NEAR(predictAfterPasses(pilot, 4).bias, 0.64, 1e-9); // control: even
    for (size_t tile = 0; tile < pilot.bias.size(); tile += 2) pilot.bias[tile] *= -1;
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

void addScatter(PilotMeasure& pilot) {
    for (size_t tile = 0; tile < pilot.bias.size(); ++tile) pilot.bias[tile] += tile % 2 ? 0.02 : -0.02;
}
constexpr double scatterOfSum = 0.16; // of 64 tiles

// Biases that noise hides say nothing for either, nor that one radius is better. Controls: biases that are resolved.
TEST(Prediction, BiasesThatAreNotToldApartAreOne) {
    PilotMeasure a = evenPilot(4, 1, 0.2, 1), b = evenPilot(4, 1, 0.3, 1);
    const auto predicted = predictedErrors({a, b}, 0);
    EXPECT_NEAR(predicted[1] - predicted[0], 0.1, 1e-9);
    for (auto* pilot : {&a, &b}) addScatter(*pilot);
    const auto hidden = predictedErrors({a, b}, 0);
    EXPECT_NEAR(hidden[0], hidden[1], 1e-9);
    b.radius = std::sqrt(2.0);
    // So many times the bias is expected of it, so it estimates a's with that much less noise.
    const double more = std::pow(2.0, 1.4);
    const double ofA = (0.2 + more * 0.3) / (1 + more * more);
    const auto apart = predictedErrors({a, b}, 0);
    EXPECT_NEAR(apart[0], 0.25 + ofA, 1e-3);
    EXPECT_NEAR(apart[1], 0.25 + more * ofA, 1e-3);
}

// Of a difference of two standard errors three quarters count. Controls: all of what is known exactly; nothing below
// one.
TEST(Prediction, BiasesCountApartAsFarAsNoiseDoesNotExplainIt) {
    const auto apart = [](double standardErrors, bool isSure) {
        const double difference = standardErrors * std::sqrt(2.0) * scatterOfSum;
        PilotMeasure a = evenPilot(4, 1, 0.3, 1), b = evenPilot(4, 1, 0.3 + difference, 1);
        if (!isSure)
            for (auto* pilot : {&a, &b}) addScatter(*pilot);
        const auto errors = predictedErrors({a, b}, 0);
        return (errors[1] - errors[0]) / difference;
    };
    // Standard errors are those of a sample of 64, n / (n - 1) in their square.
    EXPECT_NEAR(apart(2, false), 0.75, 0.01);
    EXPECT_NEAR(apart(2, true), 1, 1e-9);
    EXPECT_NEAR(apart(0.9, false), 0, 1e-9);
}

// From 8 passes of a render what 64 estimate: within 30 % of the square, 15 % of the error, since 8 passes know no
// better; the seed is fixed. One radius for all: radii by pixel, chosen in these passes, lower the noise later
// (docs/method/auto.md). Negative control: were noise not divided by passes, it would be 8 times too much.
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
    const ErrorEstimate estimate = estimateError(renderer.develop());
    const double noise = estimate.total.noiseRms * estimate.total.noiseRms;
    EXPECT_NEAR(predictAfterPasses(pilot, 64).noise / noise, 1, 0.3);
    EXPECT_GT(predictAfterPasses(pilot, 8).noise / noise, 2);
}

// --- the image is that of the choice ---

// Whatever pilots showed: the same bits as the chosen settings give by themselves, from pass 0 on, with the user's
// seed. Control: another seed gives others.
TEST(AutoImage, IsThatOfTheSettingsChosen) {
    Device device(0);
    const Scene scene = projectScene("furnace_split.xml", {{"resolution", "12"}});
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    settings.seed = 5;
    StopRule stop;
    stop.seconds = 200; // time enough to try others, however long kernels take to compile; the render is then cut short
    std::atomic<bool> interrupted = false;
    const auto onProgress = [&](const Progress& progress) {
        interrupted = progress.phase != "pilot passes" && progress.passes >= 8;
    };
    const AutoRender render = renderAuto(device, scene, settings, std::make_unique<Renderer>(device, scene, settings),
                                         {true, false, false, true, true}, stop, onProgress, nullptr, interrupted);
    EXPECT_GT(render.search.rows.size(), 1u) << "nothing was tried";
    EXPECT_EQ(render.settings.seed, 5u);
    const auto alone = [&](uint64_t seed) {
        RenderSettings chosen = render.settings;
        chosen.seed = seed;
        Renderer renderer(device, scene, chosen, Renderer(device, scene, settings).learned());
        for (unsigned pass = 0; pass < render.image.passes; ++pass) renderer.renderPass(pass);
        return renderer.develop().radiance;
    };
    EXPECT_EQ(render.image.radiance, alone(5));
    EXPECT_NE(render.image.radiance, alone(6));
}

} // namespace
} // namespace quasilux
