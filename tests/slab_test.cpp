// Turbid plates against adding-doubling and published values (support/slab_cases.cpp), for each way to split the phase
// function, both variants of the law, and BDD 0 and 1.
//
// A right render passes within 0.5 % or 3 standard errors (from 10 batches: two-sided Student t, 1.5 % a case); the
// seeds are fixed, so a case that passes goes on passing. A render with a standard error above 2 % decides nothing and
// fails.
//
// QUASILUX_SLAB_TABLE=N in the environment runs every slab with every method instead, N passes a batch, and prints a
// row of figures for each.
#include "support/slab_cases.h"
#include "support/wrong_rules.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::LawRule;
using test::MediumRule;

constexpr unsigned batches = 10;
constexpr double tolerance = 0.005;

constexpr auto R = SlabSide::reflectance, T = SlabSide::transmittance;
constexpr auto mainVariant = Variant::main, alternative = Variant::alternative;

struct Case {
    std::string slab;
    SlabSide side;
    SlabMethod method;
    unsigned passes; ///< per batch
    bool wideTube = false;
};

double truth(const Case& c) { return c.side == R ? slab(c.slab).reflectance : slab(c.slab).transmittance; }

double allowed(const Case& c, const MeanAndError& result) {
    return std::max(tolerance * truth(c), 3 * result.standardError) + 3 * slab(c.slab).error;
}

std::string describe(const Case& c) {
    return fmt::format("{}, {}, {}, {}, bdd {}{}", c.slab, c.side == R ? "R" : "T", c.method.split,
                       name(c.method.variant), c.method.bdd,
                       c.method.direct == DirectLight::photons ? ", direct photons" : "");
}

// What GoogleTest shows of a case that fails.
void PrintTo(const Case& c, std::ostream* stream) { *stream << describe(c); }

std::string label(const testing::TestParamInfo<Case>& info) {
    std::string text = describe(info.param);
    text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c) && c != ' '; }),
               text.end());
    std::replace(text.begin(), text.end(), ' ', '_');
    return fmt::format("{}_{}", text, info.index);
}

std::vector<Case> everyCase(unsigned passes) {
    std::vector<Case> cases;
    for (const Slab& s : slabs())
        for (const SlabSide side : {R, T}) {
            if (side == T && s.transmittance == 0) continue;
            for (const char* split : {"all", "level:0.1", "none"})
                for (const Variant variant : {mainVariant, alternative})
                    for (unsigned bdd : {0u, 1u}) cases.push_back({s.name, side, {split, variant, bdd}, passes});
        }
    return cases;
}

/// Passes a batch where the environment asks for the whole table, else 0.
unsigned tablePasses() {
    const char* table = std::getenv("QUASILUX_SLAB_TABLE");
    return table ? static_cast<unsigned>(std::max(1, std::atoi(table))) : 0;
}

/// One case at least for each slab's kind, split, variant and depth.
std::vector<Case> chosenCases() {
    if (tablePasses() > 0) return everyCase(tablePasses());
    return {
        {"van de Hulst", R, {"all", alternative}, 4},
        {"van de Hulst", T, {"level:0.1", mainVariant}, 2},
        {"van de Hulst", R, {"none", mainVariant, 0, DirectLight::photons}, 10},
        {"Giovanelli", R, {"none", mainVariant, 1}, 2},
        {"plate glass", R, {"level:0.1", mainVariant}, 1},
        {"plate glass", T, {"level:0.1", alternative, 1}, 1},
        {"plate open", R, {"all", alternative}, 2},
        {"plate open, 45", T, {"level:0.1", mainVariant, 1}, 1},
        {"g -0.9, tau 22.5, open", R, {"level:0.1", mainVariant}, 1},
        {"g 0.99, tau 22.5, open", T, {"all", alternative}, 1, true},
        {"g 0, tau 1, glass, 45", R, {"none", mainVariant}, 2},
        {"g 0, tau 1, open", R, {"all", mainVariant}, 3},
        {"g 0, tau 0.001, glass", T, {"none", mainVariant}, 2},
        {"g 0, tau 100, open", R, {"none", mainVariant}, 1},
        {"g 0.9, tau 100, glass", R, {"level:0.1", mainVariant}, 1},
    };
}

class SlabRender : public testing::TestWithParam<Case> {};
TEST_P(SlabRender, IsRight) {
    const Case& c = GetParam();
    const auto result = measureSlab(slab(c.slab), c.side, settingsOf(c.method), batches, c.passes, c.wideTube);
    const double exact = truth(c);
    fmt::print("{}: {:.6f} instead of {:.6f}, off by {:+.2f} %, standard error {:.2f} %\n", describe(c), result.mean,
               exact, 100 * (result.mean / exact - 1), 100 * result.standardError / exact);
    EXPECT_NEAR(result.mean, exact, allowed(c, result));
    if (tablePasses() == 0) {
        EXPECT_LT(result.standardError, 0.02 * exact) << "too noisy to decide anything";
    }
}
INSTANTIATE_TEST_SUITE_P(Slab, SlabRender, testing::ValuesIn(chosenCases()), label);

TEST(SlabEnergy, ReflectanceAndTransmittanceOfALosslessPlateAddUpToOne) {
    for (const char* plate : {"plate open", "g 0, tau 1, glass"}) {
        const RenderSettings settings = settingsOf({"level:0.1"});
        const unsigned passes = std::max(2u, tablePasses());
        const auto r = measureSlab(slab(plate), R, settings, batches, passes);
        const auto t = measureSlab(slab(plate), T, settings, batches, passes);
        const double error = std::hypot(r.standardError, t.standardError);
        fmt::print("{}: R + T = {:.5f}, standard error {:.5f}\n", plate, r.mean + t.mean, error);
        EXPECT_NEAR(r.mean + t.mean, 1, std::max(1e-3, 3 * error)) << plate << ", standard error " << error;
        EXPECT_LT(error, 0.01) << "too noisy to decide anything";
    }
}

// Negative controls: the same check must fail for every wrong reading of the law and every known mistake with media.
struct Wrong {
    const char* name;
    Case slab;
    LawRule law = LawRule::right;
    MediumRule medium = MediumRule::right;
};

class WrongSlabRender : public testing::TestWithParam<Wrong> {};
TEST_P(WrongSlabRender, IsNotRight) {
    const Wrong& wrong = GetParam();
    RenderSettings settings = settingsOf(wrong.slab.method);
    settings.controlOptions += optionOf(wrong.law);
    settings.controlOptions += optionOf(wrong.medium);
    const auto result = measureSlab(slab(wrong.slab.slab), wrong.slab.side, settings, batches, wrong.slab.passes);
    EXPECT_GT(std::abs(result.mean - truth(wrong.slab)), allowed(wrong.slab, result)) << result.mean << " looks right";
}
INSTANTIATE_TEST_SUITE_P(
    Slab, WrongSlabRender,
    testing::Values(
        Wrong{"DiffuseAtEveryHit", {"plate open", R, {"level:0.1", mainVariant, 1}, 1}, LawRule::diffuseAtEveryHit},
        Wrong{"QuasiSpecularUntilFirst",
              {"van de Hulst", R, {"level:0.1", mainVariant, 1}, 2},
              LawRule::quasiSpecularUntilFirst},
        Wrong{"FullAlongChain", {"van de Hulst", R, {"all", mainVariant}, 1}, LawRule::fullAlongChain},
        Wrong{"MissingSigmaT",
              {"plate open", R, {"level:0.1", mainVariant}, 1},
              LawRule::right,
              MediumRule::missingSigmaT},
        Wrong{"MissingEtaSquared",
              {"plate glass", R, {"level:0.1", mainVariant}, 1},
              LawRule::right,
              MediumRule::missingEtaSquared},
        Wrong{"WrongSignOfG", {"van de Hulst", R, {"none", mainVariant}, 1}, LawRule::right, MediumRule::wrongSignOfG}),
    [](const auto& row) { return std::string(row.param.name); });

} // namespace
} // namespace quasilux
