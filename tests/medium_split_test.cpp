// At which level phase functions are split, and who decides.
#include "prepare/split.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using testing::HasSubstr;
using Kind = QuasiSpecularChoice::Kind;

using std::numbers::pi;

MediumDescription medium(const std::string& id, unsigned phase, double g = 0) {
    MediumDescription description;
    description.id = id;
    description.phase = phase;
    description.g = g;
    return description;
}

QuasiSpecularChoice stated(Kind kind, double level = 0) {
    QuasiSpecularChoice choice;
    choice.kind = kind;
    choice.level = level;
    choice.stated = true;
    return choice;
}

/// Fog of HG 0.9, clear air of Rayleigh, and milk of no preferred direction.
Scene threeMedia() {
    Scene scene;
    scene.media = {medium("fog", PHASE_HG, 0.9), medium("air", PHASE_RAYLEIGH), medium("milk", PHASE_ISOTROPIC)};
    Bsdf& glass = scene.bsdfs.emplace_back();
    glass.id = "glass";
    glass.front.resize(1);
    glass.front[0].name = "diffuse";
    return scene;
}

/// The share in per cent that `why` states.
double shareIn(const std::string& why) {
    const size_t end = why.find(" %");
    if (end == std::string::npos) return -1;
    return std::stod(why.substr(why.rfind(' ', end - 1) + 1));
}

/// Of the HG function, what lies beyond the angle where it is `level`, plus the level over the cap within: closed form.
double henyeyGreensteinShare(double g, double level) {
    const double a = std::cbrt(std::pow((1 - g * g) / (4 * pi * level), 2)); // 1 + g^2 - 2 g cos at the crossing
    const double cosine = (1 + g * g - a) / (2 * g);
    const double within = (1 - g * g) / (2 * g) * (1 / (1 - g) - 1 / std::sqrt(a));
    return 1 - within + level * 2 * pi * (1 - cosine);
}

TEST(MediumSplit, AutoKeepsWhatLiesBelowItsLevel) {
    const auto decisions = decideMediumSplit(threeMedia(), "auto", false);
    ASSERT_EQ(decisions.size(), 3u);
    EXPECT_EQ(decisions[0].level, static_cast<float>(autoPhaseLevel));
    EXPECT_THAT(decisions[0].why, HasSubstr("auto: level 0.1 per sr: "));
    EXPECT_THAT(decisions[0].why, HasSubstr(" % of the scattering is genuine diffuse"));
    // Isotropic: 1 / (4 pi) = 0.0796 everywhere. Rayleigh: up to 0.119, but only 2 % of it lies above 0.1.
    EXPECT_TRUE(std::isinf(decisions[2].level));
    EXPECT_THAT(decisions[2].why, HasSubstr("auto: all of it is genuine diffuse"));
    EXPECT_TRUE(std::isinf(decisions[1].level));
    EXPECT_THAT(decisions[1].why, HasSubstr("less than 5 % of the scattering lies above 0.1 per sr"));
}

TEST(MediumSplit, TheShareStatedIsTheIntegralOfThePartBelow) {
    for (const double g : {0.3, 0.5, 0.9, 0.99, 0.9999}) {
        for (const double sign : {1.0, -1.0}) {
            Scene scene;
            scene.media = {medium("fog", PHASE_HG, sign * g)};
            const auto decision = decideMediumSplit(scene, "auto", false).at(0);
            EXPECT_NEAR(shareIn(decision.why) / 100, henyeyGreensteinShare(g, autoPhaseLevel), 6e-4) << decision.why;
            EXPECT_NEAR(decision.genuineDiffuseShare, henyeyGreensteinShare(g, autoPhaseLevel), 2e-5) << g;
        }
    }
    // Rayleigh exceeds 0.1 where cos^2 > c^2 = 1.6 pi / 3 - 1, by two caps of 2 pi (3 / (16 pi) (1 + cos^2) - 0.1)
    // each.
    const double c = std::sqrt(1.6 * pi / 3 - 1);
    const double above = 2 * 2 * pi * ((3 / (16 * pi) - 0.1) * (1 - c) + 3 / (16 * pi) * (1 - c * c * c) / 3);
    EXPECT_NEAR(shareIn(decideMediumSplit(threeMedia(), "level:0.1", false).at(1).why) / 100, 1 - above, 6e-4);
}

TEST(MediumSplit, GlobalSettings) {
    const Scene scene = threeMedia();
    for (const auto& decision : decideMediumSplit(scene, "all", false)) EXPECT_EQ(decision.level, 0);
    EXPECT_EQ(decideMediumSplit(scene, "all", false)[0].genuineDiffuseShare, 0);
    EXPECT_EQ(decideMediumSplit(scene, "none", false)[0].genuineDiffuseShare, 1);
    for (const auto& decision : decideMediumSplit(scene, "none", false)) EXPECT_TRUE(std::isinf(decision.level));
    const auto leveled = decideMediumSplit(scene, "level:0.05", false);
    for (const auto& decision : leveled) EXPECT_EQ(decision.level, 0.05f);
    EXPECT_TRUE(std::isinf(decideMediumSplit(scene, "level:1000", false)[0].level)); // the peak is 15 per sr
}

TEST(MediumSplit, AListNamesMediaAndLeavesTheOthersToAuto) {
    const auto decisions = decideMediumSplit(threeMedia(), "milk,glass", true);
    EXPECT_EQ(decisions[2].level, 0);
    EXPECT_EQ(decisions[2].why, "setting: listed");
    EXPECT_EQ(decisions[0].level, static_cast<float>(autoPhaseLevel));
}

TEST(MediumSplit, TheSceneDecidesUnlessOverridden) {
    Scene scene;
    scene.media.assign(4, medium("fog", PHASE_HG, 0.9));
    scene.media[0].quasiSpecular = stated(Kind::yes);
    scene.media[1].quasiSpecular = stated(Kind::no);
    scene.media[2].quasiSpecular = stated(Kind::level, 0.5);
    scene.media[3].quasiSpecular = stated(Kind::automatic);
    for (const bool overrides : {false, true}) {
        const auto decisions = decideMediumSplit(scene, overrides ? "auto" : "level:0.2", overrides);
        EXPECT_EQ(decisions[0].level, 0);
        EXPECT_TRUE(std::isinf(decisions[1].level));
        EXPECT_EQ(decisions[2].level, 0.5f);
        EXPECT_EQ(decisions[3].level, static_cast<float>(autoPhaseLevel));
    }
    for (const auto& decision : decideMediumSplit(scene, "level:0.2", true)) EXPECT_EQ(decision.level, 0.2f);
    for (const auto& decision : decideMediumSplit(scene, "none", true)) EXPECT_TRUE(std::isinf(decision.level));
}

TEST(MediumSplit, ListsNameMediaForLobesToo) {
    const Scene scene = threeMedia();
    EXPECT_NO_THROW(decideSplit(scene, "fog,glass", true));
    for (const auto& decide : {+[](const Scene& s) { decideSplit(s, "fgo", true); },
                               +[](const Scene& s) { decideMediumSplit(s, "fgo", true); }}) {
        try {
            decide(scene);
            ADD_FAILURE() << "decided without an error";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("no bsdf, lobe or medium 'fgo'"));
            EXPECT_THAT(error.what(), HasSubstr("glass, fog, air, milk"));
        }
    }
}

TEST(MediumSplit, ALevelLeavesLobesToAuto) {
    Scene scene = threeMedia();
    LobeDescription& lobe = scene.bsdfs[0].front[0];
    lobe.halfWidth = 0.01;
    EXPECT_EQ(decideSplit(scene, "level:0.1", true)[0].front[0].scattering, SCATTER_QUASI_SPECULAR);
    lobe.quasiSpecular = stated(Kind::no);
    EXPECT_EQ(decideSplit(scene, "level:0.1", true)[0].front[0].scattering, SCATTER_GENUINE_DIFFUSE);
}

} // namespace
} // namespace quasilux
