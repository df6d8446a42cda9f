// Kernels compiled for a scene and kernels with every feature give the same mean image: leaving out is not changing.
// Each mean has a standard error from 10 batches; they may differ by 3.5 combined standard errors (two-sided, Student t with
// about 18 degrees of freedom: 0.3 % a case; seeds are fixed). A feature lost or counted twice shows by percents.
#include "support/render_statistics.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

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
        EXPECT_LT(standardError, 0.01 * scene.mean) << "too noisy to tell anything";
    }
}
INSTANTIATE_TEST_SUITE_P(Scenes, GenericKernels,
                         testing::Values("cornell_phong.xml", "cornell_ggx.xml", "furnace_split.xml",
                                         "furnace_glass.xml"));

} // namespace
} // namespace quasilux
