// Light through a partly transparent sheet, against its closed form: a lamp shines on a black sheet above a floor, and
// the camera looks at the floor from below the sheet, so that all light has passed it once.
// A right case passes within 3 standard errors of 10 batches (Student t, 1.5 % a case; seeds are fixed) plus 0.5 % for
// the density radius.
#include "support/placed_scenes.h"
#include "support/render_statistics.h"
#include "support/shared_features.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

constexpr double floorReflectance = 0.8, intensity = 10, height = 2;

const char* const grey = R"(<float name="opacity" value="0.25"/>)";
const char* const board = R"(<texture type="checkerboard" name="opacity"><float name="color0" value="0.25"/>
    <rgb name="color1" value="0.1,0.25,0.4"/></texture>)";

Scene sheetScene(const std::string& opacity, int maxDepth) {
    return placedScene(orthographicSensor("0,0,0.5", "0,0,0", 0.05, 4) + fmt::format(R"(
<integrator type="path"><integer name="max_depth" value="{}"/></integrator>
<shape type="rectangle"><transform name="to_world"></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value="{}"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><scale value="2"/><translate z="1"/></transform>
    <bsdf type="mask">{}<bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>
<emitter type="point"><rgb name="intensity" value="{}"/><transform name="to_world"><translate z="{}"/></transform></emitter>)",
                                                                                     maxDepth, floorReflectance,
                                                                                     opacity, intensity, height),
                       Placement{});
}

MeanAndError render(const std::string& opacity, DirectLight direct, int maxDepth = -1,
                    MapOrder map = MapOrder::photons) {
    RenderSettings settings;
    settings.direct = direct;
    settings.map = map;
    settings.photonsPerPass = direct == DirectLight::photons ? 160'000 : 10'000;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.radiusScale = 0.5;
    return renderGroups(sheetScene(opacity, maxDepth), settings, std::vector<int>(16, 0), 10, 12).front();
}

const double seen = 0.75 * intensity / (height * height) * floorReflectance / std::numbers::pi;

double allowed(const MeanAndError& result) { return 3 * result.standardError + 0.005 * seen; }

class MaskedLight : public testing::TestWithParam<std::tuple<const char*, DirectLight, int>> {};
TEST_P(MaskedLight, HasTheClosedForm) {
    const auto& [opacity, direct, maxDepth] = GetParam();
    const auto result = render(opacity, direct, maxDepth);
    EXPECT_NEAR(result.mean, seen, allowed(result));
    EXPECT_LT(result.standardError, 0.01 * seen) << "too noisy to tell anything";
}
// Two segments are enough: passing the sheet begins none.
INSTANTIATE_TEST_SUITE_P(Masks, MaskedLight,
                         testing::Combine(testing::Values(grey, board),
                                          testing::Values(DirectLight::emitters, DirectLight::photons),
                                          testing::Values(-1, 2)));

TEST(MaskedLight, TheCameraMapHasIt) {
    const auto result = render(board, DirectLight::photons, -1, MapOrder::camera);
    EXPECT_NEAR(result.mean, seen, allowed(result));
}

TEST(MaskedLight, AnotherOpacityIsSeen) {
    for (const auto direct : {DirectLight::emitters, DirectLight::photons}) {
        const auto result = render(R"(<float name="opacity" value="0.31"/>)", direct);
        EXPECT_GT(std::abs(result.mean - seen), allowed(result)) << result.mean << " looks right";
    }
}

} // namespace
} // namespace quasilux
