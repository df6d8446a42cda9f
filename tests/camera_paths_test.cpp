// Several camera paths of a pixel in a pass (RenderSettings::cameraPaths): the same paths as with one in as many
// passes, of which one gathers photons for all, and how many are best.
#include "auto/prediction.h"
#include "render/learned_scene.h"
#include "support/even_pilot.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace quasilux {
namespace {

using test::optionOf, test::SamplingRule;

FilmImage render(unsigned cameraPaths, unsigned passes, const char* scene = "cornell_phong.xml") {
    RenderSettings settings;
    settings.photonsPerPass = 4000;
    settings.bdd = 1;
    settings.cameraPaths = cameraPaths;
    Renderer renderer(testDevice(), projectScene(scene, {{"resolution", "32"}}), settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    EXPECT_EQ(renderer.counters().cameraPaths, uint64_t{32} * 32 * cameraPaths * passes);
    return renderer.develop();
}

double sumOf(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double largest = 0;
    for (size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(double(a[k]) - b[k]) / (0.01 + b[k]));
    return largest;
}

// Light that needs no photons depends on nothing but the paths, so it is that of the same paths in other passes, but
// for rounding. (From four paths a pass on, nets have more points: kernels/lattice.clh.)
TEST(CameraPaths, AreThoseOfAsManyPasses) {
    const FilmImage two = render(2, 8), one = render(1, 16), fewer = render(1, 12);
    for (const unsigned component : {LIGHT_DIRECT, FILM_EMISSION})
        EXPECT_LT(largestDifference(two.components[component].radiance, one.components[component].radiance), 1e-5);
    EXPECT_GT(largestDifference(two.components[LIGHT_DIRECT].radiance, fewer.components[LIGHT_DIRECT].radiance), 0.01)
        << "control";
}

// One path gathers for four, with four times the weight: the same light of each class on surfaces, and in a medium, but
// for noise. Photons of both renders are the same, so what differs is which paths look at them. Standard errors of the
// ratios, by eight pairs of seeds: 0.6 % and 1.3 %, so a false alarm comes less than once in 10^5 runs. Were the weight
// left out, a quarter of the light would be seen.
TEST(CameraPaths, OneGathersForAll) {
    const FilmImage four = render(4, 12), one = render(1, 12);
    for (const unsigned component : {LIGHT_CAUSTIC, LIGHT_QUASI_CAUSTIC, LIGHT_DIFFUSE}) {
        SCOPED_TRACE(componentName(component));
        const auto &ours = four.components[component].radiance, &known = one.components[component].radiance;
        if (known.empty()) continue;
        EXPECT_NEAR(sumOf(ours) / sumOf(known), 1, 0.06);
    }
}

TEST(CameraPaths, OneGathersForAllInMedia) {
    EXPECT_NEAR(sumOf(render(4, 12, "furnace_medium.xml").radiance) /
                    sumOf(render(1, 12, "furnace_medium.xml").radiance),
                1, 0.06);
}

std::vector<float> diffuseLightOfPlate(unsigned cameraPaths, SamplingRule rule = SamplingRule::right) {
    Scene scene = projectScene("plate_checker.xml");
    scene.sensor.width = scene.sensor.filmWidth = 24;
    scene.sensor.height = scene.sensor.filmHeight = 18;
    RenderSettings settings;
    settings.photonsPerPass = 4000;
    settings.quasiSpecular = "level:0.1";
    settings.quasiSpecularOverridesScene = true;
    settings.cameraPaths = cameraPaths;
    settings.controlOptions += optionOf(rule);
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 4; ++pass) renderer.renderPass(pass);
    return renderer.develop().components[LIGHT_DIFFUSE].radiance;
}

// In media one path more gathers, whose numbers do not depend on how many others there are: nor does the light of
// photons. Negative control: it does where the first path gathers.
TEST(CameraPaths, InMediaOneMoreGathers) {
    EXPECT_LT(largestDifference(diffuseLightOfPlate(4), diffuseLightOfPlate(8)), 1e-6);
    constexpr auto wrong = SamplingRule::firstGathers;
    EXPECT_GT(largestDifference(diffuseLightOfPlate(4, wrong), diffuseLightOfPlate(8, wrong)), 0.01) << "control";
}

// A pass costs photons + K camera seconds and leaves a variance of photons + camera / K, which is best at K^2 = (camera
// variance / photon variance) (photon seconds / camera seconds); Kahn 1955 on splitting.
PilotMeasure pilotOf(double photonSeconds, double cameraSeconds, double photonNoise, double cameraNoise) {
    PilotMeasure pilot = evenPilot(16, photonNoise + cameraNoise, 0, photonSeconds + cameraSeconds);
    pilot.secondsOfPhotons = photonSeconds;
    pilot.noiseOfPhotons = photonNoise / (photonNoise + cameraNoise);
    return pilot;
}

// Eight samples of a pixel in a pass, at most four of a path; one where no photons are gathered, or no emitter is to be
// chosen (docs/notes/camera-paths.md#samples-of-emitters-and-nets-of-later-events).
TEST(CameraPaths, TakeFewerSamplesOfEmittersTheMoreTheyAre) {
    LearnedScene learned;
    EXPECT_EQ(directSamplesOf(learned, 1, 1), 1u);
    learned.tables.lights.resize(2);
    const std::vector<std::pair<unsigned, unsigned>> expected{{1, 4}, {2, 4}, {4, 2}, {8, 1}, {64, 1}};
    for (const auto& [paths, samples] : expected) {
        EXPECT_EQ(directSamplesOf(learned, 1, paths), samples) << paths;
        EXPECT_EQ(directSamplesOf(learned, 0, paths), 1u) << paths;
    }
}

TEST(CameraPaths, BestNumberIsTheSquareRootOfBothRatios) {
    constexpr double seconds = 1e4;
    EXPECT_EQ(bestCameraPaths(pilotOf(0.04, 0.01, 1, 16), 1, seconds), 8u);
    EXPECT_EQ(bestCameraPaths(pilotOf(0.01, 0.01, 1, 16), 1, seconds), 4u);
    EXPECT_EQ(bestCameraPaths(pilotOf(0.01, 0.01, 16, 1), 1, seconds), 1u);
    // The same one, measured by a pilot that has four of them.
    EXPECT_EQ(bestCameraPaths(withCameraPaths(pilotOf(0.04, 0.01, 1, 16), 4), 4, seconds), 8u);
    // Light that seldom is met may have noise that was not seen: paths for an eighth to a quarter of what photons cost.
    EXPECT_EQ(bestCameraPaths(pilotOf(0.7, 0.01, 16, 1), 1, seconds), 16u);
    // Few passes would not know their error: half of the 30 that one path leaves are enough, and 8 of its 8.
    EXPECT_EQ(bestCameraPaths(pilotOf(0.04, 0.01, 1, 16), 1, 1.5), 4u);
    EXPECT_EQ(bestCameraPaths(pilotOf(0.04, 0.01, 1, 16), 1, 0.4), 1u);
}

TEST(CameraPaths, PilotChangesToOtherNumbersAndBack) {
    const PilotMeasure pilot = pilotOf(0.04, 0.01, 1, 16), back = withCameraPaths(withCameraPaths(pilot, 8), 1. / 8);
    EXPECT_NEAR(withCameraPaths(pilot, 8).secondsPerPass, 0.12, 1e-12);
    EXPECT_NEAR(predictAfterPasses(withCameraPaths(pilot, 8), 16).noise, (1 + 16 / std::pow(8, 1.25)) / 16, 1e-12);
    EXPECT_NEAR(back.secondsPerPass, pilot.secondsPerPass, 1e-12);
    EXPECT_NEAR(back.noise[0], pilot.noise[0], 1e-12);
    EXPECT_NEAR(back.noiseOfPhotons, pilot.noiseOfPhotons, 1e-12);
}

// Caustics that paths find are as noisy on nets as off them. Control: those of photons, which all paths share.
TEST(CameraPaths, CausticsThatTheyFindGainNothingByNets) {
    PilotMeasure pilot = pilotOf(0.04, 0, 1, 16);
    pilot.noiseOfPhotons = 0;
    pilot.noiseOfCaustics = 0.5;
    pilot.findsCaustics = true;
    const PilotMeasure found = withCameraPaths(pilot, 16);
    EXPECT_NEAR(found.noise[0] / pilot.noise[0], 0.5 / 16 + 0.5 / 32, 1e-12);
    EXPECT_NEAR(found.noiseOfCaustics, 2. / 3, 1e-12);
    EXPECT_NEAR(withCameraPaths(found, 1. / 16).noiseOfCaustics, 0.5, 1e-12);
    pilot.findsCaustics = false;
    EXPECT_NEAR(withCameraPaths(pilot, 16).noise[0] / pilot.noise[0], 1. / 32, 1e-12);
}

} // namespace
} // namespace quasilux
