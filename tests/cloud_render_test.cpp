// Media that vary in space, rendered. A lossless cloud under a sky of radiance 1 is not seen, whatever its extinction
// does and by whatever method; an absorbing one over a floor has the same mean by every method.
//
// A right render passes within 0.5 % (between methods: 1 %) or 3 standard errors (from 20 batches: two-sided
// Student t, 0.7 % a case); the seeds are fixed. A render with a standard error above 1.5 % tells nothing and fails.
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/vol_files.h"
#include "support/wrong_rules.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::MediumRule;

constexpr unsigned batches = 20;

/// 6 x 6 x 6 voxels: a ball with holes, empty at the rim.
std::string cloudFile() {
    std::vector<float> values;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 6; ++y)
            for (int x = 0; x < 6; ++x) {
                const double dx = x - 2.5, dy = y - 2.5, dz = z - 2.5;
                const double ball = std::max(0.0, 1 - (dx * dx + dy * dy + dz * dz) / 8);
                values.push_back(static_cast<float>((x * 7 + y * 3 + z * 5) % 4 == 0 ? 0 : 8 * ball));
            }
    return test::volFile({6, 6, 6}, 1, values, {-1, -1, -1, 1, 1, 1});
}

Scene cloudScene(const std::string& medium, const std::string& more, const std::string& filter = "trilinear") {
    test::SceneFiles files;
    files.write("cloud.vol", cloudFile());
    return loadScene(files.write("scene.xml", fmt::format(R"(<scene version="3.0.0">
    <sensor type="perspective"><float name="fov" value="24"/>
        <transform name="to_world"><lookat origin="1,2,6" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/><rfilter type="box"/></film>
    </sensor>
    <shape type="sphere"><float name="radius" value="1.9"/><bsdf type="null"/>
        <medium name="interior" type="heterogeneous">{}
            <volume name="sigma_t" type="gridvolume"><string name="filename" value="cloud.vol"/>
            <string name="filter_type" value="{}"/><boolean name="use_grid_bbox" value="true"/></volume>
        </medium></shape>{}</scene>)",
                                                          medium, filter, more)));
}

const char* const sky = R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)";
const char* const lossless =
    R"(<float name="albedo" value="1"/><phase type="hg"><float name="g" value="0.4"/></phase>)";
const char* const absorbing =
    R"(<rgb name="albedo" value="0.9,0.7,0.5"/><phase type="hg"><float name="g" value="0.4"/></phase>)";
const char* const ground = R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>
    <shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate x="1" angle="-90"/><translate y="-2"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="0.3"/></bsdf></shape>)";

struct Method {
    const char* name;
    std::string split;
    unsigned bdd = 0;
    Variant variant = Variant::main;
    unsigned passes = 5; ///< per batch
    DirectLight direct = DirectLight::emitters;
    MediumRule rule = MediumRule::right;
    const char* filter = "trilinear";
};
void PrintTo(const Method& method, std::ostream* stream) { *stream << method.name; }

MeanAndError render(const Scene& scene, const Method& method) {
    RenderSettings settings;
    settings.quasiSpecular = method.split;
    settings.quasiSpecularOverridesScene = true;
    settings.variant = method.variant;
    settings.bdd = method.bdd;
    settings.direct = method.direct;
    settings.controlOptions += optionOf(method.rule);
    settings.furtherFeatures = test::mediumFeatures();
    settings.photonsPerPass = 20000;
    return renderGroups(scene, settings, std::vector<int>(64, 0), batches, method.passes).front();
}

std::string label(const testing::TestParamInfo<Method>& info) { return info.param.name; }
double allowed(const MeanAndError& result) { return std::max(0.005, 3 * result.standardError); }

class CloudFurnace : public testing::TestWithParam<Method> {};
TEST_P(CloudFurnace, IsInBalance) {
    const auto result = render(cloudScene(lossless, sky, GetParam().filter), GetParam());
    EXPECT_NEAR(result.mean, 1, allowed(result)) << "standard error " << result.standardError;
    EXPECT_LT(result.standardError, 0.015) << "too noisy to tell anything";
}
constexpr auto main_ = Variant::main, alternative = Variant::alternative;
constexpr auto emitters = DirectLight::emitters, photons = DirectLight::photons;
INSTANTIATE_TEST_SUITE_P(Render, CloudFurnace,
                         testing::Values(Method{"Level", "level:0.1"}, Method{"LevelBdd1", "level:0.1", 1},
                                         Method{"LevelAlternative", "level:0.1", 0, alternative},
                                         Method{"Standard", "none"}, Method{"StandardBdd1", "none", 1},
                                         Method{"Whole", "all", 0, alternative, 8},
                                         Method{"DirectPhotons", "level:0.1", 0, main_, 8, photons},
                                         Method{"DirectPhotonsStandard", "none", 0, main_, 8, photons},
                                         Method{"Nearest", "none", 0, main_, 8, photons, MediumRule::right, "nearest"}),
                         label);

// Negative control: flux divided by the mean extinction.
class WrongCloudFurnace : public testing::TestWithParam<Method> {};
TEST_P(WrongCloudFurnace, IsNotInBalance) {
    const auto result = render(cloudScene(lossless, sky), GetParam());
    EXPECT_GT(std::abs(result.mean - 1), allowed(result))
        << result.mean << " ± " << result.standardError << " looks right";
}
INSTANTIATE_TEST_SUITE_P(Render, WrongCloudFurnace,
                         testing::Values(Method{"MeanSigmaT", "none", 0, main_, 8, photons, MediumRule::meanSigmaT}),
                         label);

TEST(Cloud, EveryMethodHasTheSameMean) {
    const Scene scene = cloudScene(absorbing, ground);
    const auto reference = render(scene, {"Reference", "none", 3, main_, 8});
    for (const Method& method : {Method{"Level", "level:0.1"}, Method{"LevelBdd1", "level:0.1", 1},
                                 Method{"LevelAlternative", "level:0.1", 0, alternative}, Method{"Standard", "none"}}) {
        const auto result = render(scene, method);
        const double error = std::hypot(result.standardError, reference.standardError);
        EXPECT_NEAR(result.mean / reference.mean, 1, std::max(0.01, 3 * error / reference.mean))
            << method.name << ": standard error " << error / reference.mean;
        EXPECT_LT(error, 0.015 * reference.mean) << method.name << " is too noisy to tell anything";
    }
}

} // namespace
} // namespace quasilux
