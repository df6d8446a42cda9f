// The search among settings (docs/method/auto.md) on pilots made up here, whose errors and costs are known, by a clock
// that only their passes move. Nothing is left to chance.
#include "auto/search.h"
#include "render/method.h"
#include "render/pass_params.h"
#include "support/fake_search.h"
#include "support/render_statistics.h"
#include "util/error.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace quasilux {
namespace {

using testing::HasSubstr;

constexpr Freedom everything{true, true, true, true, true};

std::vector<std::string> textsOf(const std::vector<PilotRow>& rows) {
    std::vector<std::string> texts;
    for (const PilotRow& row : rows) texts.push_back(text(row.settings, row.photonsPerPass));
    return texts;
}

TEST(Search, FindsWhatIsBetter) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = (s.bdd == 1 ? 0.5 : 1) * (s.variant == Variant::alternative ? 0.6 : 1) *
                             (s.quasiSpecular == "none" ? 0.4 : 1);
        return truth;
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.bdd, 1u);
    EXPECT_EQ(found.settings.quasiSpecular, "none");
    EXPECT_THAT(found.report.line(), HasSubstr("auto: BDD 1, alternative, split none"));
}

// What was interrupted before anything was compared says so, and not that there was no time; once settings are chosen
// they are that.
TEST(Search, SaysThatItWasInterrupted) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    const Freedom all{true, true, true, true, true};
    std::atomic<bool> interrupted = true;
    const Found found = search(world, 200, all, std::nullopt, {}, 1000, &interrupted);
    EXPECT_TRUE(found.report.interrupted);
    EXPECT_THAT(found.report.line(), HasSubstr("interrupted before settings were chosen"));
    interrupted = false;
    EXPECT_FALSE(search(world, 200, all, std::nullopt, {}, 1000, &interrupted).report.interrupted);
}

// Either choice alone makes it worse; both together are the best by far.
TEST(Search, FindsWhatIsBetterOnlyTogether) {
    const World world = [](const RenderSettings& s) {
        const int changed = (s.bdd == 1) + (s.quasiSpecular == "all");
        return Truth{0.1, s.variant == Variant::alternative || changed == 1 ? 1.5 : changed == 2 ? 0.3 : 1};
    };
    const Found found = search(world, 400);
    EXPECT_EQ(found.settings.bdd, 1u);
    EXPECT_EQ(found.settings.variant, Variant::main);
    EXPECT_EQ(found.settings.quasiSpecular, "all");
}

// Methods that come to the same are one: with the main variant following everything is the standard method, and that
// knows no variants. By the other variant it has nothing that BDD would count.
TEST(Search, MethodsAreDistinct) {
    const Scene scene = projectScene("cornell_phong.xml");
    std::vector<std::string> names;
    for (const auto& method : methods({}, scene, {true, true, true, false, false})) names.push_back(text(method, 1));
    const auto is = [](const char* method) { return std::string(method) + ", 1 photons/pass, radius 1"; };
    EXPECT_THAT(names,
                testing::ElementsAre(is("BDD 0, main, split auto"), is("BDD 0, alternative, split auto"),
                                     is("BDD 0, alternative, split all"), is("BDD 1, alternative, split auto"),
                                     is("BDD 1, main, split auto"), is("BDD 1, main, split all"),
                                     is("BDD 0, alternative, split none"), is("BDD 1, alternative, split none")));
}

std::string optionsOf(const Scene& scene, const RenderSettings& method) {
    DeviceScene flat = flattenFor(scene, method);
    flat.features.directByPhotons = mayTakeDirectFromPhotons(flat.features, method);
    return kernelOptions(flat, method);
}

// Kernels are made for the classes of photons that any method stores; the sky's direct light, which only genuine
// diffuse lobes take from photons, is in those of splits without such lobes too.
TEST(Search, MethodsShareKernels) {
    for (const char* name : {"cornell_phong.xml", "../tests/scenes/compare/roughplastic.xml"}) {
        SCOPED_TRACE(name);
        const Scene scene = projectScene(name);
        const RenderSettings start = searchStart({}, scene, everything, {});
        std::set<std::string> shared, apart;
        for (const auto& method : methods(start, scene, everything)) shared.insert(optionsOf(scene, method));
        EXPECT_EQ(shared.size(), 1u);
        for (const auto& method : methods({}, scene, everything)) // control: each is compiled for what it stores
            apart.insert(optionsOf(scene, method));
        EXPECT_GT(apart.size(), 2u);
    }
}

// Negative control of FindsWhatIsBetter: the same world the other way round keeps what it started with.
TEST(Search, KeepsTheStartWhereNothingIsBetter) {
    const World world = [](const RenderSettings& s) {
        const bool isStart = s.bdd == 0 && s.variant == Variant::main && s.quasiSpecular == "auto" &&
                             s.photonsPerPass == 0 && s.radiusScale == 1;
        return Truth{0.1, isStart ? 1 : 1.3};
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.report.chosen, 0u);
    EXPECT_GT(found.report.rows.size(), 8u);
}

TEST(Search, ChangesOnlyWhatIsOpen) {
    const World world = [](const RenderSettings& s) { return Truth{0.1, s.bdd == 1 ? 0.1 : 1}; };
    EXPECT_EQ(search(world, 200, {false, true, true, true, true}).settings.bdd, 0u);
    EXPECT_EQ(search(world, 200, {true, false, false, false, false}).settings.bdd, 1u);
    EXPECT_EQ(search(world, 200, {}).report.rows.size(), 1u);
}

// One path is little of what a pass with dear photons costs: the method that is worse so is better by several paths.
TEST(Search, ComparesWithTheCameraPathsThatServeEachBest) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        const bool followsAll = s.quasiSpecular == "all" && s.variant == Variant::alternative && s.bdd == 0;
        truth.noisePerPass = followsAll ? 2 : s.quasiSpecular == "auto" && s.bdd == 0 ? 1 : 4;
        truth.noiseOfPhotons = followsAll ? 0.01 : 1;
        truth.shareOfPhotonSeconds = 0.8;
        return truth;
    };
    const Found found = search(world, 200, {true, true, true, false, false, true});
    EXPECT_EQ(found.settings.quasiSpecular, "all");
    EXPECT_GT(found.settings.cameraPaths, 4u);
    const Found withOne = search(world, 200, {true, true, true, false, false, false}); // control: one path is fixed
    EXPECT_EQ(withOne.settings.quasiSpecular, "auto");
    EXPECT_EQ(withOne.settings.cameraPaths, 1u);
}

// There is time for the first method alone, but the noise of its own passes says that more paths serve the image: three
// quarters of it are theirs.
TEST(Search, ChoosesCameraPathsWithoutTimeForOthers) {
    const auto worldOf = [](double shareOfPhotonSeconds, double noiseOfPhotons, double secondsToPrepare = 0) -> World {
        return [=](const RenderSettings&) {
            Truth truth{1, 1};
            truth.shareOfPhotonSeconds = shareOfPhotonSeconds;
            truth.noiseOfPhotons = noiseOfPhotons;
            truth.secondsToPrepare = secondsToPrepare;
            return truth;
        };
    };
    const Freedom methodsAndPaths{true, true, true, false, false, true};
    const Found found = search(worldOf(0.8, 0.25), 20, methodsAndPaths);
    EXPECT_TRUE(found.report.outOfTime);
    EXPECT_EQ(found.report.rows.size(), 1u);
    EXPECT_GT(found.settings.cameraPaths, 1u);
    EXPECT_EQ(found.report.rows[0].settings.cameraPaths, found.settings.cameraPaths);
    // Controls: photons have the noise; camera paths, opening another pilot or passes are so dear that none is to be
    // lost.
    EXPECT_EQ(search(worldOf(0.8, 1), 20, methodsAndPaths).settings.cameraPaths, 1u);
    EXPECT_EQ(search(worldOf(0.2, 0.25), 20, methodsAndPaths).settings.cameraPaths, 1u);
    EXPECT_EQ(search(worldOf(0.8, 0.25, 2), 20, methodsAndPaths).settings.cameraPaths, 1u);
    EXPECT_EQ(search(worldOf(0.8, 0.25), 14, methodsAndPaths).settings.cameraPaths, 1u);
}

TEST(Search, CostCountsAsMuchAsVariance) {
    const World world = [](const RenderSettings& s) { return s.bdd == 1 ? Truth{0.3, 0.5} : Truth{0.1, 1}; };
    EXPECT_EQ(search(world, 200).settings.bdd, 0u);
}

// A wide radius pays in a short render, a narrow one in a long one.
TEST(Search, BiasWeighsMoreTheLongerTheRender) {
    const World world = [](const RenderSettings& s) {
        Truth truth;
        truth.noisePerPass = 1 / (s.radiusScale * s.radiusScale);
        truth.bias = 0.0002 * std::pow(s.radiusScale, 4);
        return truth;
    };
    const Freedom radius{false, false, false, false, true};
    EXPECT_GT(search(world, 60, radius).settings.radiusScale, 1);
    EXPECT_LT(search(world, 1e6, radius).settings.radiusScale, 1);
}

// BDD 1 hides its bright pixels for the first 6 passes: it is not given up before, but does not win.
TEST(Search, IsNotTakenInByFewLuckyPasses) {
    World world = [](const RenderSettings& s) { return s.bdd == 1 ? Truth{0.1, 20, 0, 0.2, 6} : Truth{}; };
    EXPECT_EQ(search(world, 200).settings.bdd, 0u);
    world = [](const RenderSettings& s) { return s.bdd == 1 ? Truth{0.1, 0.2} : Truth{}; }; // control: so it would
    EXPECT_EQ(search(world, 200).settings.bdd, 1u);
}

// The better half goes on with more passes; what has over four times the least error does not, whatever the others
// have.
TEST(Search, TheBetterHalfGoesOn) {
    const auto passesOfOthers = [](double noiseOfOthers) {
        const World world = [=](const RenderSettings& s) {
            return s.bdd == 1 && s.quasiSpecular == "none" ? Truth{0.1, 1} : Truth{0.1, noiseOfOthers};
        };
        std::map<unsigned, int> count;
        for (const PilotRow& row : search(world, 400, {true, true, true, false, false}).report.rows)
            if (row.outcome == "given up") ++count[row.passes];
        std::vector<int> counts;
        for (const auto& [passes, contenders] : count) counts.push_back(contenders);
        return counts;
    };
    EXPECT_THAT(passesOfOthers(2), testing::ElementsAre(4, 2, 1)); // of eight: four are left, two, one
    EXPECT_THAT(passesOfOthers(6), testing::ElementsAre(7));
}

// Two that were opened have what is left of the time for methods, not the half of it in which others might be opened.
TEST(Search, TwoHaveTheWholeTime) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    const auto report = search(world, 10, {false, false, true, false, false}).report; // 1.2 s for 2 (0.05 s + passes)
    ASSERT_EQ(report.rows.size(), 2u);
    EXPECT_EQ(report.rows[1].passes, 5u);
    EXPECT_EQ(search(world, 6, {false, false, true, false, false}).report.rows[1].passes, 3u) << "control: less time";
}

// A path costs a fifth of the start's pass: a trial without photons has four in each of its own, unless their number is
// given.
TEST(Search, TrialsWithoutPhotonsHaveMorePaths) {
    const auto mostPaths = [](CausticLight caustics, bool isFree) {
        unsigned most = 0;
        const World world = [&](const RenderSettings& s) {
            most = std::max(most, s.cameraPaths);
            Truth truth;
            truth.shareOfPhotonSeconds = 0.8;
            return truth;
        };
        RenderSettings start;
        start.caustics = caustics;
        search(world, 200, {false, false, true, false, false, isFree, false}, std::nullopt, start);
        return most;
    };
    EXPECT_EQ(mostPaths(CausticLight::paths, true), 4u);
    EXPECT_EQ(mostPaths(CausticLight::paths, false), 1u);
    EXPECT_EQ(mostPaths(CausticLight::photons, true), 1u);
}

// Photons and radius stay where another number is hardly better: by 1.2 in relMSE it must be. Control: it is.
TEST(Search, NumbersMustWinClearly) {
    const auto photons = [](double noise) {
        const World world = [=](const RenderSettings& s) { return Truth{0.1, s.photonsPerPass == 500 ? noise : 1}; };
        return search(world, 300, {false, false, false, true, false}).report.rows.at(0).outcome;
    };
    EXPECT_EQ(photons(0.87), "chosen");
    EXPECT_EQ(photons(0.8), "given up");
}

// What would win by far fails in a pass, early or late, for whatever reason: the others go on, and it is reported.
TEST(Search, GoesOnWithoutOneThatFails) {
    for (const unsigned pass : {1u, 2u, 3u, 5u, 9u})
        for (const bool lacksMemory : {false, true}) {
            SCOPED_TRACE(fmt::format("pass {}, memory {}", pass, lacksMemory));
            const World world = [=](const RenderSettings& s) {
                return s.bdd == 1 && s.quasiSpecular == "none" ? Truth{0.1, 0.1, 0, 0, 0, pass, lacksMemory}
                       : s.bdd == 1                            ? Truth{0.1, 0.5}
                                                               : Truth{};
            };
            const Found found = search(world, 400, {true, true, true, false, false});
            EXPECT_EQ(found.settings.bdd, 1u);
            EXPECT_NE(found.settings.quasiSpecular, "none");
            EXPECT_THAT(found.report.line(), HasSubstr("settings (1 failed)"));
            const auto& rows = found.report.rows;
            EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                                    [&](const PilotRow& row) {
                                        return row.outcome ==
                                               std::string("failed: ") +
                                                   (lacksMemory ? memoryExhausted : "the device is lost");
                                    }),
                      1);
        }
}

// All fail but for the first passes, which tell what passes cost: the render is that of the start. One that cannot be
// opened at all is as good as one that fails.
TEST(Search, KeepsTheStartWhereAllFail) {
    for (const unsigned pass : {3u, 4u}) {
        const Found found = search([=](const RenderSettings&) { return Truth{0.1, 1, 0, 0, 0, pass}; }, 400);
        EXPECT_EQ(found.settings.bdd, 0u);
        EXPECT_EQ(found.settings.variant, Variant::main);
        EXPECT_EQ(found.settings.quasiSpecular, "auto");
    }
    double clock = 0;
    int opened = 0;
    SearchWorld world;
    world.open = [&](const RenderSettings&) -> std::unique_ptr<Pilot> {
        if (opened++ > 0) throw std::bad_alloc();
        return std::make_unique<FakePilot>(Truth{}, 1000, clock);
    };
    world.clock = [&] { return clock += 0.01; };
    StopRule stop;
    stop.seconds = 400;
    const Scene scene = projectScene("cornell_phong.xml");
    const auto found = Search(world, scene, everything, stop).run({}, world.open({}));
    EXPECT_GT(opened, 2);
    EXPECT_EQ(found.settings.bdd, 0u);
    EXPECT_EQ(found.settings.photonsPerPass, 0u);
}

// Other numbers win against those that the search has, or not at all: where these find no memory, nothing is changed.
// Control: with memory the others win.
TEST(Search, NumbersDoNotWinUnopposed) {
    for (const bool lacksMemory : {false, true}) {
        double clock = 0;
        int opened = 0;
        SearchWorld world;
        world.open = [&](const RenderSettings& settings) -> std::unique_ptr<Pilot> {
            const bool isStart = settings.photonsPerPass == 0 && settings.radiusScale == 1;
            if (lacksMemory && isStart && opened++ > 0) throw std::bad_alloc();
            const unsigned photons = settings.photonsPerPass > 0 ? settings.photonsPerPass : 1000;
            return std::make_unique<FakePilot>(Truth{0.1, isStart ? 1 : 0.5}, photons, clock);
        };
        world.clock = [&] { return clock += 0.01; };
        StopRule stop;
        stop.seconds = 400;
        const Scene scene = projectScene("cornell_phong.xml");
        const Freedom numbers{false, false, false, true, true};
        const auto found = Search(world, scene, numbers, stop).run({}, world.open({}));
        const bool isStart = found.settings.photonsPerPass == 0 && found.settings.radiusScale == 1;
        EXPECT_EQ(isStart, lacksMemory);
    }
}

// A step that pays is followed by the next one: to a sixteenth, and no further.
TEST(Search, GoesOnTheSameWay) {
    const World world = [](const RenderSettings& s) {
        return Truth{1e-4 * (s.photonsPerPass == 0 ? 1000 : s.photonsPerPass), 1};
    };
    EXPECT_EQ(search(world, 300, {false, false, false, true, true}).settings.photonsPerPass, 62u);
}

TEST(Search, BeginsWithPhotonsByPixelsWhereTheyAreFree) {
    const Freedom notPhotons{true, true, true, false, true};
    const Scene small = projectScene("furnace_split.xml", {{"resolution", "12"}});
    const Scene large = projectScene("cornell_phong.xml");
    const auto photons = [](const RenderSettings& settings, const Scene& scene, const Freedom& freedom,
                            const StopRule& stop) {
        return searchStart(settings, scene, freedom, stop).photonsPerPass;
    };
    EXPECT_EQ(photons({}, small, everything, {}), 2560u);
    EXPECT_EQ(photons({}, large, everything, {}), 6u * 256 * 256);
    EXPECT_EQ(photons({}, small, notPhotons, {}), 0u); // the default
    RenderSettings said;
    said.photonsPerPass = 7;
    EXPECT_EQ(photons(said, small, everything, {}), 7u);
    StopRule byPasses;
    byPasses.passes = 3;
    EXPECT_EQ(photons({}, small, everything, byPasses), 0u);
}

// Besides the two passes that measure what passes cost.
TEST(Search, KeepsToItsShareOfTheTime) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    for (const double seconds : {5.0, 10.0, 50.0, 400.0}) {
        const Found found = search(world, seconds);
        EXPECT_LE(found.report.seconds, pilotShare * seconds + 1e-9) << seconds;
        EXPECT_GT(found.report.rows.size(), 1u) << seconds;
    }
    // Where two candidates do not fit, the first passes are those of the image.
    EXPECT_THAT(search(world, 1.5).report.line(),
                HasSubstr("; tried 1 setting in 0.0 s (0 passes; the search's time limit)"));
}

// What decided is no part of the image: pilots have random numbers of their own, the choice the user's.
TEST(Search, PilotsHaveTheirOwnSeed) {
    RenderSettings start;
    start.seed = 5;
    const Found found = search([](const RenderSettings&) { return Truth{}; }, 200, everything, std::nullopt, start);
    EXPECT_EQ(found.settings.seed, 5u);
    for (const PilotRow& row : found.report.rows) EXPECT_EQ(row.passes == 0, false);
    std::set<uint64_t> seeds;
    const World world = [&](const RenderSettings& s) {
        seeds.insert(s.seed);
        return Truth{};
    };
    search(world, 200, everything, std::nullopt, start);
    EXPECT_EQ(seeds.size(), 2u); // of the first two passes, and of all pilots
}

// As where a renderer beside the others takes more memory than the device has.
TEST(Search, LeavesOutWhatDoesNotFit) {
    const World world = [](const RenderSettings& s) {
        if (s.variant == Variant::alternative) throw InputError("too little memory");
        return s.bdd == 1 ? Truth{0.1, 0.2} : Truth{};
    };
    const Found found = search(world, 200);
    EXPECT_EQ(found.settings.bdd, 1u);
    for (const PilotRow& row : found.report.rows) EXPECT_EQ(row.settings.variant, Variant::main);
}

// Of pilots that memory does not hold at once the worst one is closed. The best is found all the same.
TEST(Search, KeepsToItsShareOfMemory) {
    const World world = [](const RenderSettings& s) {
        return Truth{0.1, s.bdd == 1 && s.quasiSpecular == "none" ? 0.5 : 1};
    };
    const Found found = search(world, 400, {true, true, true, false, false}, std::nullopt, {}, 2);
    EXPECT_EQ(found.settings.bdd, 1u);
    EXPECT_EQ(found.settings.quasiSpecular, "none");
    EXPECT_THAT(textsOf(found.report.rows),
                testing::SizeIs(search(world, 400, {true, true, true, false, false}).report.rows.size()));
}

TEST(Search, PredictsTheTimeWhereOnlyAnErrorIsAskedFor) {
    const World world = [](const RenderSettings&) { return Truth{}; };
    const Found found = search(world, 1e6, everything, 0.1); // 100 passes
    EXPECT_NEAR(found.report.horizon, 10, 0.1);
    EXPECT_LE(found.report.seconds, pilotShare * found.report.horizon);
}

} // namespace
} // namespace quasilux
