// What becomes of the photons' flux: emitted = absorbed + escaped + beyond max_depth + cut + (lost - gained by chance).
//
// The balance is bookkeeping and holds in every pass to rounding (1e-4 asked). Three things make it a statement about
// the render: what the kernel emits is what the host computed from areas and radiances, in the mean where photons of a
// smooth sky differ; what is absorbed is computed from albedos, not as the rest; and chance takes as much as it gives.
// Means are held within 4 standard errors of 12 passes (Student t with 11 degrees of freedom: 0.2 % a case; seeds are
// fixed).
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::PhotonRule;

constexpr double balanceBound = 1e-4;

RenderSettings countingSettings(unsigned photons) {
    RenderSettings settings;
    settings.energyBalance = true;
    settings.photonsPerPass = photons;
    return settings;
}

RenderCounters countPasses(const Scene& scene, RenderSettings settings, unsigned passes = 2) {
    settings.furtherFeatures = test::sharedFeatures(scene);
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    return renderer.counters();
}

void expectNothingMissing(const RenderCounters& counters) {
    ASSERT_TRUE(counters.energy);
    EXPECT_LE(std::abs(counters.energy->imbalance()), balanceBound);
    EXPECT_EQ(counters.nonFinite, 0u);
}

void expectBalance(const RenderCounters& counters) {
    expectNothingMissing(counters);
    EXPECT_NEAR(counters.energy->emitted / counters.fluxEmitted, 1, balanceBound);
}

/// A small image is enough.
Scene small(Scene scene) {
    scene.sensor.width = scene.sensor.height = scene.sensor.filmWidth = scene.sensor.filmHeight = 8;
    return scene;
}

std::vector<std::string> sceneFiles() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(QUASILUX_SOURCE_DIR) + "/scenes"))
        if (entry.path().extension() == ".xml") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

class EveryScene : public testing::TestWithParam<std::string> {};
TEST_P(EveryScene, Balances) {
    constexpr unsigned passes = 12;
    auto settings = countingSettings(4000);
    settings.genericKernels = true; // two programs instead of one for each scene
    Renderer renderer(testDevice(), small(projectScene(GetParam())), settings);
    std::vector<double> emitted; // in a pass, as a share of what the host computed
    double before = 0, hostsBefore = 0;
    for (unsigned pass = 0; pass < passes; ++pass) {
        renderer.renderPass(pass);
        const RenderCounters counters = renderer.counters();
        expectNothingMissing(counters);
        emitted.push_back((counters.energy->emitted - before) / (counters.fluxEmitted - hostsBefore));
        before = counters.energy->emitted;
        hostsBefore = counters.fluxEmitted;
    }
    const MeanAndError share = meanAndError(emitted);
    const double bound = balanceBound + 4 * share.standardError;
    EXPECT_LE(std::abs(share.mean - 1), bound);
    EXPECT_GT(std::abs(1.01 * share.mean - 1), bound) << "control: 1 % too much";
}
INSTANTIATE_TEST_SUITE_P(EnergyBalance, EveryScene, testing::ValuesIn(sceneFiles()),
                         [](const auto& scene) { return scene.param.substr(0, scene.param.find('.')); });

TEST(EnergyBalance, OfTheCameraMapIsTheSame) {
    auto settings = countingSettings(2000);
    const Scene scene = small(projectScene("cornell_phong.xml"));
    const auto photons = countPasses(scene, settings);
    settings.map = MapOrder::camera;
    const auto camera = countPasses(scene, settings);
    expectBalance(camera);
    EXPECT_NEAR(camera.energy->absorbed, photons.energy->absorbed, 1e-6 * photons.energy->emitted);
    EXPECT_NEAR(camera.energy->gained, photons.energy->gained, 1e-6 * photons.energy->emitted);
}

TEST(EnergyBalance, IsNotCountedUnasked) {
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    EXPECT_FALSE(countPasses(small(projectScene("furnace_split.xml")), settings).energy);
}

TEST(EnergyBalance, DepthLimit) {
    const auto counters =
        countPasses(small(projectScene("furnace_split.xml", {{"max_depth", "3"}})), countingSettings(2000));
    expectBalance(counters);
    // Segments 1 to 3 of a path carry 1, 0.6, 0.36; what scatters once more, 0.216, is beyond.
    EXPECT_NEAR(counters.energy->beyondDepth / counters.energy->emitted, 0.216, 0.03);
}

// Perfect mirrors all around a lamp, and a small white patch so that photons have a use: nearly all paths are cut.
TEST(EnergyBalance, CutPaths) {
    const test::SceneFiles files;
    const auto file = files.write("mirrors.xml", R"(<scene version="3.0.0">
        <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
        <emitter type="point"><point name="position" x="0.3" y="0.2" z="0.1"/></emitter>
        <shape type="cube"><boolean name="flip_normals" value="true"/><bsdf type="conductor"><string name="material" value="none"/></bsdf></shape>
        <shape type="sphere"><float name="radius" value="1e-4"/><bsdf type="diffuse"/></shape></scene>)");
    const auto counters = countPasses(loadScene(file), countingSettings(40), 1);
    expectBalance(counters);
    EXPECT_GT(counters.cutPaths, 20u);
    EXPECT_GT(counters.energy->cut / counters.energy->emitted, 0.5);
}

/// Net loss by chance, relative to what was emitted.
MeanAndError lossByChance(const std::string& file, PhotonRule rule) {
    constexpr unsigned passes = 12;
    auto settings = countingSettings(20'000);
    settings.controlOptions += optionOf(rule);
    const Scene scene = small(projectScene(file));
    settings.furtherFeatures = test::sharedFeatures(scene);
    Renderer renderer(testDevice(), scene, settings);
    std::vector<double> shares;
    double before = 0;
    for (unsigned pass = 0; pass < passes; ++pass) {
        renderer.renderPass(pass);
        const EnergyBalance& energy = *renderer.counters().energy;
        shares.push_back((energy.lost - energy.gained - before) * (pass + 1) / energy.emitted);
        before = energy.lost - energy.gained;
    }
    return meanAndError(shares);
}

// Albedos of these scenes are known exactly.
TEST(EnergyBalance, ChanceTakesAsMuchAsItGives) {
    for (const char* file : {"furnace_split.xml", "furnace_textured.xml", "furnace_medium.xml"}) {
        const MeanAndError share = lossByChance(file, PhotonRule::right);
        EXPECT_LE(std::abs(share.mean), 4 * share.standardError) << file;
        EXPECT_LT(share.standardError, 0.005) << file << " is too noisy to decide anything";
    }
}

// Negative controls: a term that is not counted; light made of nothing.
TEST(EnergyBalanceControl, ALostTermIsFound) {
    auto settings = countingSettings(2000);
    settings.controlOptions += optionOf(PhotonRule::escapeNotCounted);
    const auto counters = countPasses(small(projectScene("plate_checker.xml")), settings);
    EXPECT_GT(std::abs(counters.energy->imbalance()), balanceBound);
}
TEST(EnergyBalanceControl, ScatteringThatGainsIsFound) {
    const MeanAndError share = lossByChance("furnace_split.xml", PhotonRule::scatteringGains);
    EXPECT_LT(share.mean, -4 * share.standardError);
}

} // namespace
} // namespace quasilux
