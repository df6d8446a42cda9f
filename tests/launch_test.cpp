// Launches of kernels are cut where they would last too long. Nothing is left to chance.
#include "device/launch_pace.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>
#include <numeric>

namespace quasilux {
namespace {

TEST(LaunchPace, AsManyWorkItemsAsTheTimeAllows) {
    LaunchPace pace;
    EXPECT_EQ(pace.next(1000000, 64), 1000000u) << "nothing is known";
    pace.note(1000, 0.1); // 1e-4 s each
    EXPECT_EQ(pace.next(1000000, 64, 0.5), 4992u) << "5000 in whole groups";
    EXPECT_EQ(pace.next(640, 64, 0.5), 640u) << "no more than are left";
    EXPECT_EQ(pace.next(1000000, 64, 1e-9), 64u) << "a group at the least";
    pace.note(64, 64.0);
    EXPECT_EQ(pace.next(1000000, 64, 0.5), 64u) << "by the last launch";
    EXPECT_EQ(LaunchPace(256).next(1000000, 64), 256u) << "a device whose driver ends long launches begins with few";
}

uint64_t launches() { return testDevice().timings().at("mixNumbers").launches; }

TEST(Launches, InPartsGiveTheSameAsInOne) {
    std::vector<uint64_t> numbers(10000);
    std::iota(numbers.begin(), numbers.end(), 1);
    Buffer<uint64_t> in(testDevice(), numbers, "input"), out(testDevice(), numbers.size(), "mixed");
    Program program = testProgram("rng.cl");
    Kernel mix = program.kernel("mixNumbers");
    const auto mixed = [&] {
        out.fill(0);
        mix.launch(numbers.size(), in, out, cl_uint(numbers.size()));
        return out.read();
    };
    const auto whole = mixed();
    EXPECT_EQ(launches(), 1u);
    testDevice().setLongestLaunch(1e-9);
    EXPECT_EQ(mixed(), whole);
    EXPECT_EQ(launches(), 1u + (numbers.size() + 63) / 64) << "each group for itself";
    testDevice().setLongestLaunch(longestLaunchSeconds);
    mix.forgetPace();
    EXPECT_EQ(mixed(), whole);
    EXPECT_EQ(launches(), 2u + (numbers.size() + 63) / 64) << "control: in one where there is time";
}

struct Enough {};

TEST(Launches, AreWatchedAndEndedByWhoWatches) {
    std::vector<uint64_t> numbers(1000);
    Buffer<uint64_t> in(testDevice(), numbers, "input"), out(testDevice(), numbers.size(), "mixed");
    Program program = testProgram("rng.cl");
    Kernel mix = program.kernel("mixNumbers");
    const auto mixAll = [&] { mix.launch(numbers.size(), in, out, cl_uint(numbers.size())); };
    mixAll();
    const uint64_t before = launches();
    testDevice().setLongestLaunch(1e-9);
    unsigned watched = 0;
    testDevice().watchLaunches([&] {
        if (++watched == 4) throw Enough();
    });
    EXPECT_THROW(mixAll(), Enough);
    EXPECT_EQ(launches(), before + 3) << "parts of one";
    testDevice().watchLaunches({});
    EXPECT_NO_THROW(mixAll());
    EXPECT_EQ(launches(), before + 3 + (numbers.size() + 63) / 64) << "control";
    testDevice().setLongestLaunch(longestLaunchSeconds);
}

TEST(Launches, BeginWithThePaceOfThoseBefore) {
    std::vector<uint64_t> numbers(1000);
    const auto launchesOfNew = [&](bool keepsPaces) {
        Device device({}, testDevice().workGroupSize());
        if (keepsPaces) device.keepPaces();
        Buffer<uint64_t> in(device, numbers, "input"), out(device, numbers.size(), "mixed");
        Program program = testProgram(device, "rng.cl");
        const auto launch = [&](Kernel mix) {
            for (int k = 0; k < 2; ++k) {
                mix.launch(numbers.size(), in, out, cl_uint(numbers.size()));
                device.finish();
            }
            return device.timings().at("mixNumbers").launches;
        };
        const uint64_t before = launch(program.kernel("mixNumbers"));
        device.setLongestLaunch(1e-9);
        return launch(program.kernel("mixNumbers")) - before;
    };
    const size_t groups = (numbers.size() + 63) / 64;
    EXPECT_EQ(launchesOfNew(true), 2 * groups) << "each group for itself";
    EXPECT_EQ(launchesOfNew(false), 1 + groups) << "control: the first launch is whole on a CPU";
}

} // namespace
} // namespace quasilux
