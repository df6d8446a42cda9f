// Caustic light that camera paths find by meeting emitters (CausticLight::paths): closed forms, where glass, mirrors
// and a medium behind glass must not be seen; where it is refused; and what is known of its noise before it is tried.
//
// A right rule passes within 4 standard errors (from 8 seeds: two-sided Student t, 0.5 % a case); the seeds are fixed,
// so a case that passes goes on passing.
#include "auto/prediction.h"
#include "support/even_pilot.h"
#include "support/path_tracing.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"
#include "util/error.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>

namespace quasilux {
namespace {

constexpr unsigned seeds = 8, passes = 16;
constexpr unsigned carried = 1u << LIGHT_CAUSTIC | 1u << LIGHT_QUASI_CAUSTIC | 1u << LIGHT_DIFFUSE;

double meanOf(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Found {
    MeanAndError image, caustics;
};

Found render(const Scene& scene, RenderSettings settings) {
    std::vector<double> images, caustics;
    for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
        Renderer renderer(testDevice(), scene, settings);
        for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
        const FilmImage image = renderer.develop();
        images.push_back(meanOf(image.radiance));
        caustics.push_back(meanOf(image.components[LIGHT_CAUSTIC].radiance));
    }
    return {meanAndError(images), meanAndError(caustics)};
}

// Where all paths bring the same, what is left is rounding.
constexpr double rounding = 1e-5;
double allowed(const Found& found) { return 4 * found.image.standardError + rounding; }

struct Case {
    const char* name;
    const char* file;
    std::vector<std::pair<std::string, std::string>> parameters;
    double truth;
};

class CausticsByPaths : public testing::TestWithParam<Case> {
protected:
    static Scene scene() { return projectScene(GetParam().file, GetParam().parameters); }
};

TEST_P(CausticsByPaths, GiveTheClosedForm) {
    const Found found = render(scene(), pathTracing());
    const double truth = GetParam().truth;
    EXPECT_NEAR(found.image.mean, truth, allowed(found));
    EXPECT_LT(found.image.standardError, 0.005 * truth) << "too noisy to decide anything";
    EXPECT_GT(std::abs(found.image.mean - found.caustics.mean - truth), allowed(found)) << "control: none found";
    EXPECT_GT(std::abs(found.image.mean + found.caustics.mean - truth), allowed(found)) << "control: found twice";
}

// In a search kernels serve methods that take caustics from photons, too, and the first pass fills a map.
TEST_P(CausticsByPaths, AreNotTakenFromPhotonsToo) {
    RenderSettings settings = pathTracing();
    const Found alone = render(scene(), settings);
    settings.furtherClasses = carried | carried << LIGHT_CLASSES;
    const Found among = render(scene(), settings);
    EXPECT_NEAR(among.image.mean, GetParam().truth, allowed(among));
    EXPECT_NEAR(among.caustics.mean, alone.caustics.mean,
                4 * std::hypot(alone.caustics.standardError, among.caustics.standardError) + rounding);
}

INSTANTIATE_TEST_SUITE_P(
    Furnaces, CausticsByPaths,
    testing::Values(Case{"GlassAndMirrors", "furnace_glass.xml", {{"resolution", "24"}}, 2.5},
                    Case{"MediumBehindGlass", "furnace_medium.xml", {{"border", "glass"}, {"resolution", "16"}}, 1}),
    [](const testing::TestParamInfo<Case>& row) { return row.param.name; });

std::string refusal(const Scene& scene, const RenderSettings& settings) {
    try {
        Renderer(testDevice(), scene, settings);
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(CausticsByPaths, AreRefusedWherePhotonsAreNeeded) {
    using testing::HasSubstr;
    const Scene glass = projectScene("furnace_glass.xml");
    RenderSettings settings = pathTracing();
    settings.quasiSpecular = "auto";
    EXPECT_THAT(refusal(glass, settings), HasSubstr("--caustics paths: photons of other classes are in use"));
    settings = pathTracing();
    settings.variant = Variant::main;
    EXPECT_THAT(refusal(glass, settings), HasSubstr("--variant alternative"));
    settings = pathTracing();
    settings.genericKernels = true;
    EXPECT_THAT(refusal(glass, settings), HasSubstr("take --kernels scene"));
    settings = pathTracing();
    settings.map = MapOrder::camera;
    EXPECT_THAT(refusal(glass, settings), HasSubstr("--map camera"));
    Scene spot = glass;
    PointEmitter point;
    point.intensity = {1, 1, 1};
    spot.pointEmitters.push_back(point);
    EXPECT_THAT(refusal(spot, pathTracing()), HasSubstr("emitters that no path can meet"));
    EXPECT_EQ(refusal(glass, pathTracing()), "accepted");
}

// What one path brings is at most the emitter's radiance: the noise that is predicted from photons' caustics is never
// less than what paths have.
TEST(CausticsByPaths, HaveNoMoreNoiseThanPhotonsPredict) {
    const Scene scene = projectScene("furnace_glass.xml", {{"resolution", "24"}});
    const auto imageOf = [&](CausticLight caustics) {
        RenderSettings settings = pathTracing();
        settings.caustics = caustics;
        Renderer renderer(testDevice(), scene, settings);
        for (unsigned pass = 0; pass < 4 * passes; ++pass) renderer.renderPass(pass);
        return renderer.develop();
    };
    const double predicted = noiseOfFinding(imageOf(CausticLight::photons), LIGHT_CAUSTIC, 1);
    const double found =
        std::pow(estimateError(imageOf(CausticLight::paths)).components[LIGHT_CAUSTIC].noiseRms, 2) * 4 * passes;
    EXPECT_LT(found, predicted);
    EXPECT_GT(found, 0.05 * predicted) << "the bound says nothing";
    EXPECT_GT(found, noiseOfFinding(imageOf(CausticLight::photons), LIGHT_CAUSTIC, 0.1))
        << "control: emitters a tenth as bright";
}

// Before any is met, what photons predict counts; when many were, their own noise.
TEST(CausticsByPaths, CountAsMetOnceBeforeTheyAre) {
    PilotMeasure pilot = evenPilot(2, 1, 0, 0.1);
    const auto noise = [](const PilotMeasure& of) { return std::accumulate(of.noise.begin(), of.noise.end(), 0.0); };
    pilot.noiseOfCaustics = pilot.causticsMet = 0;
    EXPECT_NEAR(noise(withRareCaustics(pilot, 40, 1)), 0.5 + 40. / 2, 1e-9);
    EXPECT_NEAR(noise(withRareCaustics(pilot, 40, 4)), 0.5 + 40. / 8, 1e-9);
    pilot.noiseOfCaustics = 0.5;
    pilot.causticsMet = 999;
    const double caustics = (999 * 0.25 + 20) / 1000;
    EXPECT_NEAR(noise(withRareCaustics(pilot, 40, 1)), 0.25 + caustics, 1e-9);
    EXPECT_NEAR(withRareCaustics(pilot, 40, 1).noiseOfCaustics, caustics / (0.25 + caustics), 1e-9);
}

} // namespace
} // namespace quasilux
