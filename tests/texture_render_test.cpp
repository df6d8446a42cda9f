// Textures in images: a closed form that a texture must not change, and squares whose radiances stand in the ratio of
// their reflectances. Bounds as in furnace_test.cpp: 3 standard errors of 10 batches (1.5 % a case) plus 0.5 %.
#include "support/render_statistics.h"
#include "support/shared_features.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using Parameters = std::vector<std::pair<std::string, std::string>>;

class TexturedFurnace : public testing::TestWithParam<std::tuple<DirectLight, const char*>> {
protected:
    static MeanAndError render(Parameters parameters) {
        parameters.emplace_back("resolution", "16");
        RenderSettings settings;
        settings.direct = std::get<0>(GetParam());
        settings.quasiSpecular = std::get<1>(GetParam());
        settings.quasiSpecularOverridesScene = settings.quasiSpecular != "auto";
        settings.furtherFeatures = test::surfaceFeatures();
        settings.photonsPerPass = 8000;
        settings.bdd = 1;
        return renderGroups(projectScene("furnace_textured.xml", parameters), settings, std::vector<int>(256, 0), 10,
                            12)
            .front();
    }
};
TEST_P(TexturedFurnace, HasTheClosedFormForTwoEqualColours) {
    const auto result = render({});
    EXPECT_NEAR(result.mean, 2.5, 3 * result.standardError + 0.005 * 2.5);
    EXPECT_LT(result.standardError, 0.025);
}
TEST_P(TexturedFurnace, MissesItForOthers) {
    const auto result = render({{"color1", "0.5,0.5,0.5"}});
    EXPECT_GT(std::abs(result.mean - 2.5), 3 * result.standardError + 0.005 * 2.5);
}
INSTANTIATE_TEST_SUITE_P(Textures, TexturedFurnace,
                         testing::Combine(testing::Values(DirectLight::emitters, DirectLight::photons),
                                          testing::Values("auto", "all")));

constexpr unsigned resolution = 32;

/// Mean radiance of the quarters of scenes/textured_plane.xml, without a margin of 4 pixels about their borders that
/// photons may cross: left bottom (u, v < 1/2), right bottom, left top, right top.
std::vector<MeanAndError> renderQuarters(DirectLight direct, Parameters parameters = {}) {
    parameters.emplace_back("resolution", std::to_string(resolution));
    std::vector<int> group(resolution * resolution, -1);
    for (unsigned y = 0; y < resolution; ++y)
        for (unsigned x = 0; x < resolution; ++x) {
            const auto inside = [](unsigned i) { return i % 16 >= 4 && i % 16 < 12; };
            if (inside(x) && inside(y)) group[y * resolution + x] = int(x / 16 + 2 * (1 - y / 16));
        }
    RenderSettings settings;
    settings.direct = direct;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = 40'000;
    return renderGroups(projectScene("textured_plane.xml", parameters), settings, group, 10, 6);
}

/// By symmetry all quarters get the same light: their radiances are as color0 to color1 in places, or not.
void expectRatios(const std::vector<MeanAndError>& quarters, bool asTheBoard, double ratio) {
    const auto within = [&](size_t dark, size_t bright) {
        const double difference = quarters[bright].mean - ratio * quarters[dark].mean;
        const double error = std::hypot(quarters[bright].standardError, ratio * quarters[dark].standardError);
        return std::abs(difference) <= 3 * error + 0.005 * quarters[bright].mean;
    };
    EXPECT_EQ(within(1, 0) && within(1, 3) && within(2, 0) && within(2, 3), asTheBoard)
        << quarters[0].mean << " " << quarters[1].mean << " " << quarters[2].mean << " " << quarters[3].mean << " +- "
        << quarters[0].standardError;
}

class TexturedPlane : public testing::TestWithParam<DirectLight> {};
TEST_P(TexturedPlane, ReflectsAsItsSquares) {
    const auto quarters = renderQuarters(GetParam());
    expectRatios(quarters, true, 4);
    EXPECT_LT(quarters[0].standardError, 0.01 * quarters[0].mean) << "too noisy to decide anything";
}
TEST_P(TexturedPlane, SwappedColoursAreSeen) {
    expectRatios(renderQuarters(GetParam(), {{"color0", "0.2,0.2,0.2"}, {"color1", "0.8,0.8,0.8"}}), false, 4);
}
TEST_P(TexturedPlane, AnotherTransformIsSeen) { expectRatios(renderQuarters(GetParam(), {{"tiles", "2"}}), false, 4); }
INSTANTIATE_TEST_SUITE_P(Textures, TexturedPlane, testing::Values(DirectLight::emitters, DirectLight::photons));

} // namespace
} // namespace quasilux
