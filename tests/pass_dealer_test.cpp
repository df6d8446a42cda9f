// Which passes a worker is given, simulated without devices; lists of devices; states that are sent.
#include "device/device_choice.h"
#include "share/pass_dealer.h"
#include "share/shared_render.h"
#include "util/error.h"
#include "util/memory_state.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(PassRanges, ThatTouchAreOne) {
    EXPECT_THAT(joined({{8, 12}, {0, 4}, {20, 20}, {4, 8}, {16, 20}}),
                ElementsAre(PassRange{0, 12}, PassRange{16, 20}));
    EXPECT_THAT(joined({}), IsEmpty());
}

TEST(DeviceList, NamesDevicesAndParts) {
    const auto texts = [](const std::string& list, size_t devices) {
        std::vector<std::string> all;
        for (const auto& choice : devicesOf(list, devices)) all.push_back(text(choice));
        return all;
    };
    EXPECT_THAT(texts("", 3), ElementsAre("device"));
    EXPECT_THAT(texts("2", 3), ElementsAre("device 2"));
    EXPECT_THAT(texts("1,0", 3), ElementsAre("device 1", "device 0"));
    EXPECT_THAT(texts("all", 2), ElementsAre("device 0", "device 1"));
    EXPECT_THAT(texts("1,0/2", 2), ElementsAre("device 1", "device 0 part 1 of 2", "device 0 part 2 of 2"));
    for (const char* bad : {"", "-1", "x", "1,", ",1", "0/", "0/0", "/2", "0/1/2", "all,0", "1001", " 0", "+1"})
        EXPECT_FALSE(parseDeviceList(bad)) << bad;
    EXPECT_THROW(devicesOf("0,2", 2), InputError);
    EXPECT_THROW(devicesOf("all", 0), InputError);
}

TEST(DeviceList, IsSharedAmongThoseOfAMachine) {
    const auto all = devicesOf("all", 3);
    EXPECT_THAT(shareOf(all, 0, 1), ElementsAre(all[0], all[1], all[2]));
    EXPECT_THAT(shareOf(all, 0, 2), ElementsAre(all[0], all[2]));
    EXPECT_THAT(shareOf(all, 1, 2), ElementsAre(all[1]));
    EXPECT_THAT(shareOf(all, 4, 5), ElementsAre(all[1])); // more programs than devices
}

TEST(MemoryState, ComesBackAsItWas) {
    MemoryState state;
    StateSink& sink = state;
    sink.array("a", std::vector<float>{1, 2, 3});
    sink.record("b", 7u);
    sink.array("none", std::vector<int>{});
    sink.array("a", std::vector<float>{4}); // replaced
    const auto packed = state.packed();
    const MemoryState back = MemoryState::unpacked(packed);
    const StateSource& source = back;
    EXPECT_THAT(source.array<float>("a"), ElementsAre(4));
    EXPECT_EQ(source.record<unsigned>("b"), 7u);
    EXPECT_THAT(source.array<int>("none"), IsEmpty());
    EXPECT_THROW(source.record<double>("b"), InputError);
    EXPECT_THROW(source.array<int>("c"), InputError);
    for (size_t size = 1; size < packed.size(); ++size) {
        const std::vector<char> cut(packed.begin(), packed.begin() + static_cast<std::ptrdiff_t>(size));
        bool isRefused = false, isWhole = false;
        try {
            isWhole = MemoryState::unpacked(cut).packed() == cut; // cut between two arrays
        } catch (const InputError&) {
            isRefused = true;
        }
        EXPECT_TRUE(isRefused || isWhole) << size;
    }
}

TEST(PassDealer, GivesWholeBatchesFromTheFirstPassOn) {
    PassDealer dealer(6, 21);
    const std::vector<WorkerLoad> two(2); // nothing is known of them
    std::vector<PassRange> given;
    while (const auto passes = dealer.take(given.size() % 2, two, INFINITY)) given.push_back(*passes);
    EXPECT_THAT(
        given, ElementsAre(PassRange{6, 8}, PassRange{8, 12}, PassRange{12, 16}, PassRange{16, 20}, PassRange{20, 21}));
    EXPECT_FALSE(dealer.hasMore());
}

TEST(PassDealer, GivesBackFirst) {
    PassDealer dealer(0, 100);
    const std::vector<WorkerLoad> one(1);
    EXPECT_EQ(dealer.take(0, one, INFINITY), (PassRange{0, 4}));
    dealer.giveBack({0, 4});
    EXPECT_EQ(dealer.take(0, one, INFINITY, true), (PassRange{0, 4}));
    EXPECT_EQ(dealer.take(0, one, INFINITY, true), std::nullopt);
    EXPECT_EQ(dealer.take(0, one, INFINITY), (PassRange{4, 8}));
}

// As many at once as take half a second, fewer where little is left.
TEST(PassDealer, GivesMoreToTheFast) {
    PassDealer endless(0, std::nullopt);
    const std::vector<WorkerLoad> workers{{0.01, 0}, {1, 0}};
    EXPECT_EQ(endless.take(0, workers, INFINITY), (PassRange{0, 48}));
    EXPECT_EQ(endless.take(1, workers, INFINITY), (PassRange{48, 52}));
    EXPECT_EQ(endless.take(0, workers, 0.2), (PassRange{52, 60})); // half of what is left
    PassDealer few(0, 40);
    EXPECT_EQ(few.take(0, workers, INFINITY), (PassRange{0, 8}));
}

// Workers of these speeds, in virtual time; one may fail once it has begun so many passes.
struct Simulated {
    std::vector<double> secondsPerPass;
    size_t failing = SIZE_MAX;
    unsigned failsAfter = 0;

    struct Outcome {
        double end = 0;
        std::vector<unsigned> rendered; ///< how often each pass was, but for what was lost
        std::vector<unsigned> byWorker;
    };
    Outcome run(unsigned passes) const {
        Outcome outcome;
        outcome.rendered.resize(passes);
        outcome.byWorker.resize(secondsPerPass.size());
        PassDealer dealer(0, passes);
        struct State {
            double freeAt = 0;
            std::optional<PassRange> running{};
            bool isKnown = false, isAlive = true;
        };
        std::vector<State> states(secondsPerPass.size());
        for (double now = 0;;) {
            std::vector<WorkerLoad> loads;
            for (size_t k = 0; k < states.size(); ++k)
                loads.push_back({states[k].isKnown && states[k].isAlive ? secondsPerPass[k] : 0,
                                 states[k].running ? states[k].freeAt - now : 0});
            for (size_t k = 0; k < states.size(); ++k) {
                if (states[k].running || !states[k].isAlive) continue;
                states[k].running = dealer.take(k, loads, INFINITY);
                if (!states[k].running) continue;
                states[k].freeAt = now + secondsPerPass[k] * (states[k].running->end - states[k].running->first);
                loads[k].busyFor = states[k].freeAt - now;
            }
            const auto next = std::min_element(states.begin(), states.end(), [](const State& a, const State& b) {
                return (a.running ? a.freeAt : INFINITY) < (b.running ? b.freeAt : INFINITY);
            });
            if (!next->running) return outcome;
            now = outcome.end = next->freeAt;
            const auto k = static_cast<size_t>(next - states.begin());
            if (k == failing && outcome.byWorker[k] >= failsAfter) {
                dealer.giveBack(*next->running);
                next->isAlive = false;
            } else {
                for (unsigned pass = next->running->first; pass < next->running->end; ++pass) ++outcome.rendered[pass];
                outcome.byWorker[k] += next->running->end - next->running->first;
                next->isKnown = true;
            }
            next->running.reset();
        }
    }
};

TEST(PassDealer, SharesPassesBySpeedAndLosesNone) {
    const std::vector<double> seconds{1, 0.5, 0.25, 3, 0.01};
    double rate = 0;
    for (const double one : seconds) rate += 1 / one;
    for (const size_t failing : {SIZE_MAX, size_t(2), size_t(4)}) {
        const auto outcome = Simulated{seconds, failing, 40}.run(5000);
        EXPECT_THAT(outcome.rendered, testing::Each(1u)) << failing;
        if (failing != SIZE_MAX) continue;
        EXPECT_LT(outcome.end, 5000 / rate + 4 * 0.25 + 12); // 12: the slowest one's first batch, of unknown time
        EXPECT_NEAR(outcome.byWorker[4], 5000 / rate / 0.01, 0.05 * 5000);
    }
}

// A slow one is given no last batch that fast ones have done sooner. Control: an even share would take 12 s and more.
TEST(PassDealer, EndsWithoutWaitingForTheSlow) {
    const auto outcome = Simulated{{0.1, 0.1, 3}, SIZE_MAX, 0}.run(400);
    EXPECT_THAT(outcome.rendered, testing::Each(1u));
    EXPECT_EQ(outcome.byWorker[2], 4u); // the first, since nothing was known of it
    EXPECT_LT(outcome.end, 20.5);
}

TEST(PassDealer, EqualOnesDoNotWaitForEachOther) {
    EXPECT_THAT((Simulated{{1, 1}, SIZE_MAX, 0}.run(4).rendered), testing::Each(1u));
    EXPECT_EQ((Simulated{{1, 1}, SIZE_MAX, 0}.run(16).end), 8);
}

/// Two, both of which fail: the first with the first passes of all, the second when it has given its own.
class FailingWorkers : public PassWorkers {
public:
    bool wantsSums = false;
    PassRange given; ///< to the second, at first

    std::optional<WorkerEvent> wait(double) override {
        using enum WorkerEvent::Kind;
        switch (step_++) {
        case 0:
            return event(opened, 0);
        case 1:
            return event(opened, 1);
        case 2:
            wantsSums = true;
            return event(rendered, 1);
        case 3:
            return event(gave, 1);
        case 4:
            return event(failed, 0);
        case 5:
            return event(summed, 0);
        default:
            return event(failed, 1);
        }
    }
    bool areOpening() const override { return step_ < 2; }
    void render(size_t worker, const PassRange& passes) override {
        if (worker == 1 && given.end == 0) given = passes;
    }
    void giveRadii(const RadiiState&) override {}
    void askForSums() override { wantsSums = false; }
    PassSums takeSums() override {
        PassSums sums;
        sums.shape = {1, 1, {}};
        sums.film.resize(sums.shape.layout.floatsPerPixel());
        sums.counts.batches = 1;
        sums.counters.passes = given.end - given.first;
        return sums;
    }

private:
    WorkerEvent event(WorkerEvent::Kind kind, size_t worker) const {
        WorkerEvent event;
        event.kind = kind;
        event.worker = worker;
        event.passes = given;
        event.seconds = 1;
        if (kind == WorkerEvent::Kind::opened) event.radii = std::make_shared<RadiiState>(RadiiState{{}, true});
        return event;
    }
    unsigned step_ = 0;
};

// Passes that lack others before them are no state to go on from: they are no checkpoint, and that is said.
TEST(SharedRender, GapsAreNoStateToGoOnFrom) {
    FailingWorkers workers;
    SharedStart start;
    unsigned whole = 0;
    std::vector<PassRange> there;
    SharedHooks hooks;
    hooks.onSums = [&](const SharedPasses&, double, bool) { ++whole; };
    hooks.onGap = [&](const std::vector<PassRange>& passes) { there = passes; };
    hooks.secondsToNextSums = [&] { return workers.wantsSums ? 0. : 1e9; };
    StopRule stop;
    stop.passes = 100;
    const std::atomic<bool> interrupted{false};
    const RenderOutcome outcome = SharedRender(workers, std::move(start), stop, hooks, interrupted).run();
    EXPECT_TRUE(outcome.failure);
    EXPECT_EQ(outcome.counters.passes, 4u);
    EXPECT_EQ(whole, 0u);
    ASSERT_EQ(there.size(), 1u);
    EXPECT_EQ(there[0].first, 4u);
}

} // namespace
} // namespace quasilux
