// The law in the renderer itself, against a closed form: in scenes/furnace_split.xml every point has radiance 2.5. All
// its surfaces emit, scatter genuinely diffusely and quasi-specularly, and lie in direct light, so each wrong reading
// shows.
//
// A right rule passes within 3 standard errors (from 10 batches: two-sided Student t, 1.5 % a case) plus 0.5 % for the
// density radius; the seeds are fixed, so a case that passes goes on passing.
#include "support/render_statistics.h"
#include "support/shared_features.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::LawRule;

constexpr double truth = 2.5;
constexpr double biasBound = 0.005;
constexpr unsigned resolution = 16, batches = 10, passesPerBatch = 12;

struct Method {
    const char* name;
    unsigned bdd;
    Variant variant;
    const char* quasiSpecular;
    DirectLight direct;
    LawRule rule = LawRule::right;
};

using Parameters = std::vector<std::pair<std::string, std::string>>;

MeanAndError renderFurnace(const Method& method, const std::string& file = "furnace_split.xml",
                           Parameters parameters = {}) {
    parameters.emplace_back("resolution", std::to_string(resolution));
    const auto scene = projectScene(file, parameters);
    RenderSettings settings;
    settings.bdd = method.bdd;
    settings.variant = method.variant;
    settings.quasiSpecular = method.quasiSpecular;
    settings.quasiSpecularOverridesScene = settings.quasiSpecular != "auto";
    settings.direct = method.direct;
    settings.controlOptions += optionOf(method.rule);
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = 8000;
    return renderGroups(scene, settings, std::vector<int>(resolution * resolution, 0), batches, passesPerBatch).front();
}

double allowed(const MeanAndError& result) { return 3 * result.standardError + biasBound * truth; }

std::string label(const testing::TestParamInfo<Method>& info) { return info.param.name; }

class RightRule : public testing::TestWithParam<Method> {};
TEST_P(RightRule, GivesTheClosedForm) {
    const auto result = renderFurnace(GetParam());
    EXPECT_NEAR(result.mean, truth, allowed(result)) << "standard error " << result.standardError;
    EXPECT_LT(result.standardError, 0.01 * truth) << "too noisy to decide anything";
}
constexpr auto emitters = DirectLight::emitters;
constexpr auto photons = DirectLight::photons;
INSTANTIATE_TEST_SUITE_P(
    Furnace, RightRule,
    testing::Values(Method{"MainBdd0", 0, Variant::main, "auto", emitters},
                    Method{"MainBdd1", 1, Variant::main, "auto", emitters},
                    Method{"MainBdd2", 2, Variant::main, "auto", emitters},
                    Method{"AlternativeBdd0", 0, Variant::alternative, "auto", emitters},
                    Method{"AlternativeBdd1", 1, Variant::alternative, "auto", emitters},
                    Method{"AlternativeBdd2", 2, Variant::alternative, "auto", emitters},
                    Method{"StandardBdd0", 0, Variant::main, "none", emitters},
                    Method{"StandardBdd1", 1, Variant::main, "none", emitters},
                    Method{"StandardBdd2", 2, Variant::main, "none", emitters},
                    Method{"MainBdd0DirectPhotons", 0, Variant::main, "auto", photons},
                    Method{"MainBdd2DirectPhotons", 2, Variant::main, "auto", photons},
                    Method{"AlternativeBdd1DirectPhotons", 1, Variant::alternative, "auto", photons},
                    Method{"StandardBdd1DirectPhotons", 1, Variant::main, "none", photons},
                    Method{"AllQuasiSpecular", 0, Variant::main, "all", emitters},
                    Method{"AllQuasiSpecularAlternative", 0, Variant::alternative, "all", photons}),
    label);

// max_depth limits the segments of the whole path, photon plus camera: the series 1 + 0.6 + 0.36 + … ends there.
TEST_P(RightRule, EndsTheSeriesAtTheDepthLimit) {
    for (const int depth : {2, 4}) {
        const double sum = (1 - std::pow(0.6, depth)) / (1 - 0.6);
        const auto result = renderFurnace(GetParam(), "furnace_split.xml", {{"max_depth", std::to_string(depth)}});
        EXPECT_NEAR(result.mean, sum, allowed(result)) << "max_depth " << depth;
    }
}

// A lossless glass ball and a mirror in the furnace must not be seen: caustic photons, specular chains of camera paths,
// refraction's 1 / eta^2 both ways.
TEST_P(RightRule, SeesNothingOfGlassAndMirrors) {
    const auto result = renderFurnace(GetParam(), "furnace_glass.xml");
    EXPECT_NEAR(result.mean, truth, allowed(result)) << "standard error " << result.standardError;
}

// Nor masks and blends with nothing, by number and by texture: what passes is no event, of paths, photons and shadow
// rays.
TEST_P(RightRule, SeesNothingOfMasks) {
    const auto result = renderFurnace(GetParam(), "furnace_mask.xml");
    EXPECT_NEAR(result.mean, truth, allowed(result)) << "standard error " << result.standardError;
}
TEST(Furnace, SeesMasksThatAbsorb) {
    const auto result =
        renderFurnace({"Grey", 1, Variant::main, "auto", emitters}, "furnace_mask.xml", {{"reflectance", "0.8"}});
    EXPECT_GT(std::abs(result.mean - truth), allowed(result)) << result.mean << " looks right";
}

// Negative controls: the same check must fail for every wrong reading of the law.
class WrongRule : public testing::TestWithParam<Method> {};
TEST_P(WrongRule, MissesTheClosedForm) {
    const auto result = renderFurnace(GetParam());
    EXPECT_GT(std::abs(result.mean - truth), allowed(result)) << result.mean << " looks right";
}
INSTANTIATE_TEST_SUITE_P(
    Furnace, WrongRule,
    testing::Values(
        Method{"QuasiSpecularUntilFirstBdd1", 1, Variant::main, "auto", emitters, LawRule::quasiSpecularUntilFirst},
        Method{"QuasiSpecularUntilFirstBdd2", 2, Variant::main, "auto", photons, LawRule::quasiSpecularUntilFirst},
        Method{"DiffuseAtEveryHitBdd1", 1, Variant::main, "auto", emitters, LawRule::diffuseAtEveryHit},
        Method{"DiffuseAtEveryHitBdd2", 2, Variant::alternative, "auto", photons, LawRule::diffuseAtEveryHit},
        Method{"FullAlongChainBdd0", 0, Variant::main, "auto", emitters, LawRule::fullAlongChain},
        Method{"FullAlongChainBdd0Photons", 0, Variant::main, "auto", photons, LawRule::fullAlongChain}),
    label);

} // namespace
} // namespace quasilux
