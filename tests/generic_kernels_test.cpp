// Kernels compiled for a scene and kernels with every feature give the same mean image: leaving out is not changing.
// Each mean has a standard error from 10 batches; they may differ by 3.5 combined standard errors (two-sided, Student t
// with about 18 degrees of freedom: 0.3 % a case; seeds are fixed). A feature lost or counted twice shows by percents.
#include "support/render_statistics.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace quasilux {
namespace {

constexpr unsigned resolution = 24, batches = 10, passesPerBatch = 8;

MeanAndError meanRadiance(const std::string& file, bool generic, DirectLight direct) {
    RenderSettings settings;
    settings.genericKernels = generic;
    settings.direct = direct;
    settings.photonsPerPass = 20'000;
    settings.seed = generic ? 1 : 2; // the estimates must be independent
    const auto scene = projectScene(file, {{"resolution", std::to_string(resolution)}});
    // Without the upper third, where the Cornell boxes show their light: few bright pixels would hold all the noise.
    std::vector<int> group(resolution * resolution, 0);
    std::fill_n(group.begin(), resolution * resolution / 3, -1);
    return renderGroups(scene, settings, group, batches, passesPerBatch).front();
}

class GenericKernels : public testing::TestWithParam<const char*> {};
TEST_P(GenericKernels, GiveTheImageOfTheSceneKernels) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto scene = meanRadiance(GetParam(), false, direct), generic = meanRadiance(GetParam(), true, direct);
        const double standardError = std::hypot(scene.standardError, generic.standardError);
        EXPECT_NEAR(generic.mean, scene.mean, 3.5 * standardError) << "direct light by " << name(direct);
        EXPECT_LT(standardError, 0.01 * scene.mean) << "too noisy to decide anything";
    }
}
INSTANTIATE_TEST_SUITE_P(Scenes, GenericKernels,
                         testing::Values("cornell_phong.xml", "cornell_ggx.xml", "furnace_split.xml",
                                         "furnace_glass.xml"));

/// What the kernels are compiled for.
enum class Compiled { forScene, shared, generic };

std::vector<float> radianceOf(const std::string& file, Compiled kernels, uint64_t seed) {
    const auto scene = projectScene(file, {{"resolution", std::to_string(resolution)}});
    RenderSettings settings;
    settings.genericKernels = kernels == Compiled::generic;
    if (kernels == Compiled::shared) settings.furtherFeatures = test::sharedFeatures(scene);
    settings.photonsPerPass = 20'000;
    settings.seed = seed;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 4; ++pass) renderer.renderPass(pass);
    return renderer.develop().radiance;
}

/// By the scene's own kernels; rendered once.
const std::vector<float>& radianceOfScene(const std::string& file, uint64_t seed) {
    static std::map<std::pair<std::string, uint64_t>, std::vector<float>> rendered;
    auto& radiance = rendered[{file, seed}];
    if (radiance.empty()) radiance = radianceOf(file, Compiled::forScene, seed);
    return radiance;
}

/// Root mean square of the difference relative to the mean.
double relativeDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0, sum = 0;
    for (size_t k = 0; k < a.size(); ++k) {
        squares += (a[k] - b[k]) * double(a[k] - b[k]);
        sum += a[k];
    }
    return std::sqrt(squares / double(a.size())) / (sum / double(a.size()));
}

// Without media behind glass, where generic kernels look for emitters in vain, they make the same estimate, not just
// one of the same mean: else comparing their speed would compare estimators. What is compiled differently rounds
// differently, and some paths then part. Control: other random numbers.
void expectTheEstimateOfTheSceneKernels(const std::string& file, Compiled compiled) {
    SCOPED_TRACE(file);
    const auto radiance = radianceOf(file, compiled, 1);
    EXPECT_LT(relativeDifference(radianceOfScene(file, 1), radiance), 2e-3);
    EXPECT_GT(relativeDifference(radianceOfScene(file, 2), radiance), 2e-2);
}

TEST(GenericKernelsEstimate, IsThatOfTheSceneKernels) {
    for (const char* file : {"cornell_ggx.xml", "furnace_split.xml", "furnace_glass.xml", "furnace_sky.xml"})
        expectTheEstimateOfTheSceneKernels(file, Compiled::generic);
}

// So do kernels that the scenes of many tests share, with media, too.
TEST(SharedKernelsEstimate, IsThatOfTheSceneKernels) {
    for (const char* file : {"cornell_ggx.xml", "furnace_split.xml", "furnace_glass.xml", "furnace_sky.xml", "slab.xml",
                             "furnace_medium.xml"})
        expectTheEstimateOfTheSceneKernels(file, Compiled::shared);
}

} // namespace
} // namespace quasilux
