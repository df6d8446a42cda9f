// The search among settings (docs/auto.md) on pilots made up here, whose errors and costs are known, by a clock that only their
// passes move. Nothing is left to chance.
#include "auto/search.h"
#include "support/even_pilot.h"
#include "support/render_statistics.h"
#include "util/error.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

struct Truth {
    double secondsPerPass = 0.1, noisePerPass = 1, bias = 0;
    double firstNoise = 0; // told before `honestFrom` passes, all of it even; 0: honest from the start
    unsigned honestFrom = 0;
    double photonShare = 0.5; // of the time
};
using World = std::function<Truth(const RenderSettings&)>;

class FakePilot : public Pilot {
public:
    FakePilot(const Truth& truth, unsigned photons, double& clock) : truth_(truth), photons_(photons), clock_(clock) {}
    void renderPass() override {
        clock_ += truth_.secondsPerPass;
        ++passes_;
    }
    unsigned passes() const override { return passes_; }
    PilotMeasure measure() const override {
        const bool lies = passes_ < truth_.honestFrom;
        PilotMeasure pilot =
            evenPilot(passes_, lies ? truth_.firstNoise : truth_.noisePerPass, truth_.bias, truth_.secondsPerPass);
        pilot.photonShare = truth_.photonShare;
        return pilot;
    }
    unsigned photonsPerPass() const override { return photons_; }
    double openingSeconds() const override { return 0.05; }

private:
    Truth truth_;
    unsigned photons_, passes_ = 0;
    double& clock_;
};

struct Found {
    RenderSettings settings;
    SearchReport report;
};

Found search(const World& world, double seconds, Freedom freedom = {true, true, true, true, true},
             std::optional<double> error = std::nullopt, const RenderSettings& start = {}) {
    double clock = 0;
    SearchWorld searched;
    searched.open = [&](const RenderSettings& settings) {
        clock += 0.05;
        const unsigned photons = settings.photonsPerPass > 0 ? settings.photonsPerPass : 1000;
        return std::make_unique<FakePilot>(world(settings), photons, clock);
    };
    searched.clock = [&] { return clock; };
    const Scene scene = projectScene("cornell_phong.xml");
    StopRule stop;
    stop.seconds = seconds;
    stop.relativeError = error;
    auto result = Search(searched, scene, freedom, stop).run(start, searched.open(start));
    return {result.settings, result.report};
}

TEST(Search, FindsWhatIsBetterInEachCoordinate) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = (s.bdd == 1 ? 0.5 : 1) * (s.variant == Variant::alternative ? 0.6 : 1) *
                             (s.quasiSpecular == "all" ? 0.4 : 1);
        return truth;
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.bdd, 1u);
    EXPECT_EQ(found.settings.variant, Variant::alternative);
    EXPECT_EQ(found.settings.quasiSpecular, "all");
    EXPECT_THAT(found.report.line(), HasSubstr("auto: BDD 1, alternative, split all"));
}

// Following everything pays with the alternative variant only; with the main one it is the standard method.
TEST(Search, FollowsEverythingInTheAlternativeVariantOnly) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        const bool isAlternative = s.variant == Variant::alternative;
        truth.noisePerPass = s.quasiSpecular == "all" && isAlternative ? 0.1 : isAlternative ? 1.5 : 1;
        return truth;
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.quasiSpecular, "all");
    EXPECT_EQ(found.settings.variant, Variant::alternative);
    Freedom noVariant{true, true, false, true, true};
    const Found main = search(world, 200, noVariant);
    for (const auto& row : main.report.rows)
        EXPECT_FALSE(row.settings.quasiSpecular == "all" && row.settings.bdd == 0) << "the same as none";
    EXPECT_EQ(main.report.chosen, 0u);
}

// Negative control of FindsWhatIsBetterInEachCoordinate: the same world the other way round keeps what it started with.
TEST(Search, KeepsTheStartWhereNothingIsBetter) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        const bool isStart = s.bdd == 0 && s.variant == Variant::main && s.quasiSpecular == "auto" &&
                             s.photonsPerPass == 0 && s.radiusScale == 1;
        truth.noisePerPass = isStart ? 1 : 1.3;
        return truth;
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.report.chosen, 0u);
    EXPECT_GT(found.report.rows.size(), 3u);
}

// BDD 0 pays only with another split, which is better with BDD 1 too. There is no time for a second round.
TEST(Search, TriesShorterPathsAgainWithTheSplitThatWon) {
    const World world = [](const RenderSettings& s) {
        const bool split = s.quasiSpecular == "none";
        return Truth{0.1, split ? (s.bdd == 0 ? 0.2 : 0.5) : s.bdd == 0 ? 1.5 : 1};
    };
    RenderSettings start;
    start.bdd = 1;
    const Found found = search(world, 17, {true, true, true, true, true}, std::nullopt, start);
    EXPECT_EQ(found.settings.bdd, 0u);
    EXPECT_EQ(found.settings.quasiSpecular, "none");
}

TEST(Search, ChangesOnlyWhatIsOpen) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = s.bdd == 1 ? 0.1 : 1;
        return truth;
    };
    EXPECT_EQ(search(world, 200, {false, true, true, true, true}).settings.bdd, 0u);
    EXPECT_EQ(search(world, 200, {true, false, false, false, false}).settings.bdd, 1u);
    EXPECT_EQ(search(world, 200, {}).report.rows.size(), 1u);
}

TEST(Search, CostCountsAsMuchAsVariance) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = s.bdd == 1 ? 0.5 : 1;
        truth.secondsPerPass = s.bdd == 1 ? 0.3 : 0.1;
        return truth;
    };
    EXPECT_EQ(search(world, 200).settings.bdd, 0u);
}

// A wide radius pays in a short render, a narrow one in a long one.
TEST(Search, BiasWeighsMoreTheLongerTheRender) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = 1 / (s.radiusScale * s.radiusScale);
        truth.bias = 0.005 * std::pow(s.radiusScale, 4);
        return truth;
    };
    const Freedom radius{false, false, false, false, true};
    EXPECT_GT(search(world, 6, radius).settings.radiusScale, 1);
    EXPECT_LT(search(world, 1e6, radius).settings.radiusScale, 1);
}

// BDD 1 hides its bright pixels for the first 6 passes. It may not win by what those passes told.
TEST(Search, IsNotTakenInByFewLuckyPasses) {
    World world = [](const RenderSettings& s) {
        Truth truth;
        if (s.bdd == 1) truth = {0.1, 20, 0, 0.2, 6};
        return truth;
    };
    EXPECT_EQ(search(world, 200).settings.bdd, 0u);
    world = [](const RenderSettings& s) { return s.bdd == 1 ? Truth{0.1, 0.2} : Truth{}; }; // control: so it would
    EXPECT_EQ(search(world, 200).settings.bdd, 1u);
}

// A candidate that is better, but not by what its first 5 passes tell. Where passes take little of the time for pilots, it is
// not judged by so few. Controls: where they take much of it, it is; and what has no hope is given up all the same.
TEST(Search, JudgesLaterWherePassesAreCheap) {
    const auto told = [](double firstNoise) {
        return [=](const RenderSettings& s) { return s.bdd == 1 ? Truth{0.1, 0.2, 0, firstNoise, 6} : Truth{}; };
    };
    const Freedom bdd{true, false, false, false, false};
    EXPECT_EQ(search(told(1.3), 200, bdd).settings.bdd, 1u);
    EXPECT_EQ(search(told(1.3), 20, bdd).settings.bdd, 0u);
    const Found hopeless = search(told(5), 200, bdd);
    EXPECT_EQ(hopeless.settings.bdd, 0u);
    EXPECT_EQ(hopeless.report.rows.at(1).passes, 4u);
}

// As where passes grow cheaper than the first ones let expect: alike for 70 passes, better after. Controls: what is not as close,
// or takes longer, is given up before.
TEST(Search, CloseCallsGoOnWherePassesAreCheap) {
    const auto found = [](double secondsPerPass, double firstNoise) {
        return search(
                   [=](const RenderSettings& s) {
                       return s.bdd == 1 ? Truth{secondsPerPass, 0.7, 0, firstNoise, 70} : Truth{secondsPerPass};
                   },
                   125, {true, false, false, false, false})
            .settings.bdd;
    };
    EXPECT_EQ(found(0.02, 1.1), 1u);
    EXPECT_EQ(found(0.02, 1.4), 0u);
    EXPECT_EQ(found(0.1, 1.1), 0u);
}

// Where the ratio of bias and noise speaks for neither more nor fewer photons, their share of a pass's time does; and what
// promises nothing comes last.
TEST(Search, TriesFewerPhotonsWhereTheyTakeNearlyAllTimeAndMoreWhereTheyTakeLittle) {
    const auto tried = [](double share, double bias) {
        const World world = [&](const RenderSettings&) { return Truth{0.1, 1, bias, 0, 0, share}; };
        std::vector<std::string> texts; // the first ones are what is started with
        for (const PilotRow& row : search(world, 40, {false, false, false, true, true}).report.rows)
            texts.push_back(fmt::format("{} {:.2g}", row.photonsPerPass, row.settings.radiusScale));
        return texts;
    };
    const double none = 0, much = 1;
    EXPECT_THAT(tried(0.5, none), testing::ElementsAre("1000 1", "500 1", "1000 1.4", "2000 1"));
    EXPECT_THAT(tried(0.2, none), testing::ElementsAre("1000 1", "2000 1", "500 1", "1000 1.4"));
    EXPECT_THAT(tried(0.5, much), testing::ElementsAre("1000 1", "2000 1", "1000 0.71", "500 1"));
    EXPECT_THAT(tried(0.8, much), testing::ElementsAre("1000 1", "2000 1", "500 1", "1000 0.71"));
}

// Where photons take most of a pass, other candidates wait until there are fewer. Control: where they take less.
TEST(Search, TriesPhotonsFirstWhereTheyTakeMostOfThePass) {
    const auto firstTried = [](double share) {
        const World world = [=](const RenderSettings& s) {
            const double photons = s.photonsPerPass == 0 ? 1 : s.photonsPerPass / 1000.0;
            return Truth{0.1 * (share * photons + 1 - share), 1, 0, 0, 0, share};
        };
        return search(world, 100).report.rows.at(1).photonsPerPass;
    };
    EXPECT_EQ(firstTried(0.6), 500u);
    EXPECT_EQ(firstTried(0.4), 1000u);
}

// A step that pays is followed by the next one: to a sixteenth, not to a half by round.
TEST(Search, GoesOnTheSameWay) {
    const World world = [](const RenderSettings& s) {
        const double photons = s.photonsPerPass == 0 ? 1000 : s.photonsPerPass;
        return Truth{1e-4 * photons, 1, 0, 0, 0, 0.9};
    };
    const Found found = search(world, 100);
    EXPECT_EQ(found.settings.photonsPerPass, 62u);
    for (const unsigned row : {1u, 2u, 3u, 4u}) EXPECT_EQ(found.report.rows.at(row).photonsPerPass, 1000u >> row);
}

TEST(Search, BeginsWithPhotonsByPixelsWhereTheyAreFree) {
    const Freedom all{true, true, true, true, true}, notPhotons{true, true, true, false, true};
    const Scene small = projectScene("furnace_split.xml", {{"resolution", "12"}});
    const Scene large = projectScene("cornell_phong.xml");
    const auto photons = [](const RenderSettings& settings, const Scene& scene, const Freedom& freedom,
                            const StopRule& stop) {
        return searchStart(settings, scene, freedom, stop).photonsPerPass;
    };
    EXPECT_EQ(photons({}, small, all, {}), 2560u);
    EXPECT_EQ(photons({}, large, all, {}), 6u * 256 * 256);
    EXPECT_EQ(photons({}, small, notPhotons, {}), 0u); // the default
    RenderSettings said;
    said.photonsPerPass = 7;
    EXPECT_EQ(photons(said, small, all, {}), 7u);
    StopRule byPasses;
    byPasses.passes = 3;
    EXPECT_EQ(photons({}, small, all, byPasses), 0u);
}

TEST(Search, KeepsToItsShareOfTheTime) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    for (const double seconds : {2.0, 10.0, 50.0}) {
        const Found found = search(world, seconds);
        EXPECT_LE(found.report.seconds, pilotShare * seconds + 1e-9) << seconds;
    }
    const auto rows = search(world, 3).report.rows; // a candidate of the same kernels, once
    ASSERT_EQ(rows.size(), 2u);
    const Scene scene = projectScene("cornell_phong.xml");
    EXPECT_EQ(kernelKey(rows[1].settings, scene), kernelKey(rows[0].settings, scene));
    EXPECT_EQ(search(world, 1.8).report.rows.size(), 1u);
    EXPECT_THAT(search(world, 1).report.line(), HasSubstr("(1 candidate, 0 passes of others"));
}

// As where a renderer beside the best one takes more memory than the device has.
TEST(Search, LeavesOutWhatDoesNotFit) {
    const World world = [](const RenderSettings& s) {
        if (s.variant == Variant::alternative) throw InputError("too little memory");
        return s.bdd == 1 ? Truth{0.1, 0.2} : Truth{};
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.bdd, 1u);
    for (const PilotRow& row : found.report.rows) EXPECT_EQ(row.settings.variant, Variant::main);
}

// A tenth less noise is not sure after four passes. In a short render no more are spent on it, in a long one (control) they are.
TEST(Search, OneDuelDoesNotTakeAllTime) {
    const World world = [](const RenderSettings& s) { return Truth{0.1, s.photonsPerPass == 0 ? 1 : 0.9}; };
    const Freedom photons{false, false, false, true, false};
    const auto mostPasses = [&](double seconds) {
        unsigned most = 0;
        for (const PilotRow& row : search(world, seconds, photons).report.rows) most = std::max(most, row.passes);
        return most;
    };
    EXPECT_EQ(mostPasses(12), 4u);
    EXPECT_GT(mostPasses(200), 4u);
}

TEST(Search, PredictsTheTimeWhereOnlyAnErrorIsAskedFor) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    const Found found = search(world, 1e6, {true, true, true, true, true}, 0.1); // 100 passes, 10 s
    EXPECT_NEAR(found.report.horizon - found.report.seconds, 10, 2);             // pilots come on top
    EXPECT_LE(found.report.seconds, pilotShare * found.report.horizon);
}

} // namespace
} // namespace quasilux
