// Photons seen through a coat, eight at a time (kernels/coat_lanes.clh), against the evaluation of the lobe photon by photon: the same photons, so
// the same image but for rounding. Nothing is statistical. The control: an index that is wrong by 2 % is told apart.
#include "render/renderer.h"
#include "support/image_difference.h"
#include "support/placed_scenes.h"
#include "support/test_kernels.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

constexpr double rounding = 1e-4; // relative, of sums of some hundred photons

std::string coat(const std::string& type, double index) {
    return fmt::format(
        R"(<bsdf type="{}"><float name="int_ior" value="{}"/><float name="ext_ior" value="1"/><rgb name="diffuse_reflectance" value="0.6,0.5,0.3"/></bsdf>)",
        type, index);
}

std::string besideDiffuse(const std::string& bsdf) {
    return R"(<bsdf type="blendbsdf"><float name="weight" value="0.7"/><bsdf type="diffuse"/>)" + bsdf + "</bsdf>";
}

/// The corner of a floor and a wall, so that light comes from everywhere and discs are cut.
FilmImage render(const std::string& bsdf, int maxDepth, const std::string& options) {
    const Scene scene = placedScene(orthographicSensor("0,0,1.5", "0,0,0", 1, 16) + fmt::format(R"(
<integrator type="path"><integer name="max_depth" value="{0}"/></integrator>
<shape type="rectangle"><bsdf type="twosided">{1}</bsdf></shape>
<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="90"/><translate x="-0.5"/></transform><bsdf type="twosided">{1}</bsdf></shape>
<emitter type="point"><rgb name="intensity" value="10"/><transform name="to_world"><translate x="0.4" z="0.6"/></transform></emitter>)",
                                                                                                maxDepth, bsdf),
                                    Placement{});
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    settings.photonsPerPass = 20'000;
    settings.controlOptions = options;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 2; ++pass) renderer.renderPass(pass);
    return renderer.develop();
}

class Coat : public testing::TestWithParam<std::tuple<const char*, bool, int>> {};
TEST_P(Coat, GathersAsLobesDoOneByOne) {
    const auto& [type, isBlended, maxDepth] = GetParam();
    const auto imageOf = [&, blended = isBlended, depth = maxDepth](double index, const std::string& options) {
        const std::string bsdf = coat(type, index);
        return render(blended ? besideDiffuse(bsdf) : bsdf, depth, options);
    };
    const FilmImage eight = imageOf(1.5, ""), one = imageOf(1.5, " -DCOATS_ONE_BY_ONE");
    EXPECT_LT(largestDifference(eight.radiance, one.radiance), rounding);
    EXPECT_NE(eight.radiance, one.radiance) << "both are the same code";
    double bias = 0, apart = 0;
    for (size_t k = 0; k < one.bias.size(); ++k) {
        bias += std::abs(one.bias[k]);
        apart += std::abs(double(eight.bias[k]) - one.bias[k]);
    }
    EXPECT_GT(bias, 0);
    EXPECT_LT(apart, rounding * bias);
    EXPECT_GT(largestDifference(imageOf(1.53, "").radiance, one.radiance), 10 * rounding)
        << "nothing would be told apart";
}
INSTANTIATE_TEST_SUITE_P(Plastics, Coat,
                         testing::Values(std::tuple{"plastic", false, -1}, std::tuple{"roughplastic", true, -1},
                                         std::tuple{"plastic", true, 3}, std::tuple{"roughplastic", false, 3}));

} // namespace
} // namespace quasilux
