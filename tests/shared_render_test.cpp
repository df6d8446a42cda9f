// One render on several devices: the sum of the same passes, whichever fail (docs/reference/reliability.md). The halves
// of one device are two; a library between the program and OpenCL makes one of them bad (shims/bad_device.cpp).
#include "support/image_difference.h"
#include "support/lit_plate.h"
#include "support/program_runner.h"

#include "compare/image_file.h"
#include "output/render_checkpoint.h"

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using testing::HasSubstr;
using Arguments = std::vector<std::string>;

class SharedRenderTest : public CommandLineTest {
protected:
    SharedRenderTest() { std::ofstream(folder / "scene.xml") << test::litPlate(8); }

    static Arguments render(const Arguments& more) {
        Arguments all{"render", "scene.xml", "--photons", "4096", "--fixed", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    /// By both halves of device 0.
    static Arguments shared(const Arguments& more) {
        Arguments all = render({"--device", "0/2"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    nlohmann::json summaryOf(const Arguments& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return nlohmann::json::parse(outcome.output);
    }
    Outcome runBad(const Arguments& arguments, const Variables& variables) const {
        return runWith(QUASILUX_BAD_DEVICE, arguments, variables);
    }
    struct Image {
        std::vector<float> radiance, standardError;
    };
    Image imageOf(const std::string& file) const {
        const auto image = readRadiance((folder / file).string());
        return {image.radiance, image.standardError};
    }
    /// By one device, as a whole.
    const Image& whole(const std::string& passes) const {
        static std::map<std::string, Image> known;
        Image& image = known[passes];
        if (!image.radiance.empty()) return image;
        const Outcome outcome = run(render({"-o", "whole.exr", "--passes", passes}));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return image = imageOf("whole.exr");
    }
    /// To one unit in the last place of 24 bits; the standard error, a difference of sums, to some more.
    void expectPassesOf(const std::string& file, const std::string& passes) const {
        const Image image = imageOf(file), &other = whole(passes);
        EXPECT_LT(largestDifference(image.radiance, other.radiance), 1.2e-7);
        EXPECT_LT(largestDifference(image.standardError, other.standardError), 1e-5);
    }
};

TEST_F(SharedRenderTest, IsTheSumOfTheSamePasses) {
    const auto summary = summaryOf(shared({"-o", "a.exr", "--passes", "800", "--stats", "a.json"}));
    expectPassesOf("a.exr", "800");
    const auto& workers = summary.at("workers");
    ASSERT_EQ(workers.size(), 2u);
    EXPECT_GT(workers[0].at("passes"), 16);
    EXPECT_GT(workers[1].at("passes"), 0) << workers; // control: it did take part
    EXPECT_EQ(workers[0].at("passes").get<int>() + workers[1].at("passes").get<int>(), 800);
    EXPECT_EQ(workers[1].at("name"), "device 0 part 2 of 2");
    const auto statistics = nlohmann::json::parse(readText(folder / "a.json"));
    EXPECT_EQ(statistics.at("workers"), workers);
    EXPECT_EQ(statistics.at("counters").at("passes"), 800);
    EXPECT_EQ(statistics.at("counters").at("photonsEmitted"), 800 * 4096);
    EXPECT_GE(statistics.at("kernels").at("traceCameraPaths").at("launches"), 800);
    // Control: one pass makes that much.
    EXPECT_GT(largestDifference(imageOf("a.exr").radiance, whole("1:801").radiance), 1e-6);
}

// As long as radii are being chosen, one device renders alone; passes need not begin with the first, nor end with a
// batch.
TEST_F(SharedRenderTest, FewPassesAndRangesAreTheSame) {
    for (const char* passes : {"3", "18", "6:47"}) {
        summaryOf(shared({"-o", "a.exr", "--passes", passes}));
        expectPassesOf("a.exr", passes);
    }
}

TEST_F(SharedRenderTest, StopsByTimeAndByError) {
    const auto byTime = summaryOf(shared({"-o", "a.exr", "--time", "3"}));
    EXPECT_GT(byTime.at("seconds"), 2);
    EXPECT_LT(byTime.at("seconds"), 6);
    EXPECT_GT(byTime.at("passes"), 16);
    const auto byError = summaryOf(shared({"-o", "b.exr", "--error", "0.02", "--time", "60"}));
    EXPECT_LE(byError.at("relativeError"), 0.02);
    EXPECT_LT(byError.at("seconds"), 55);
}

// Checkpoints hold for one device and for several, either way, also those that SIGTERM has written.
TEST_F(SharedRenderTest, CheckpointsAreThoseOfOneDevice) {
    const auto hasPasses = [&] { return std::filesystem::exists(folder / "a.ckpt.previous"); };
    const Outcome ended = runUntil(shared({"-o", "a.exr", "--time", "500", "--checkpoint", "a.ckpt", "--every", "0"}),
                                   hasPasses, SIGTERM);
    ASSERT_EQ(ended.exitCode, 128 + SIGTERM) << ended.errors;
    const auto passes = nlohmann::json::parse(ended.output).at("passes").get<unsigned>();
    ASSERT_GT(passes, 16u);
    const Checkpoint checkpoint = checkpointOf(CheckpointReader((folder / "a.ckpt").string()));
    EXPECT_EQ(checkpoint.counters.passes, passes);
    ASSERT_EQ(checkpoint.passes.size(), 1u);
    const std::string more = std::to_string(passes + 32), most = std::to_string(passes + 100);
    summaryOf(render({"-o", "b.exr", "--passes", more, "--resume", "a.ckpt", "--checkpoint", "b.ckpt"}));
    expectPassesOf("b.exr", more);
    summaryOf(shared({"-o", "c.exr", "--passes", most, "--resume", "b.ckpt", "--checkpoint", "c.ckpt"}));
    expectPassesOf("c.exr", most);
    summaryOf(shared({"-o", "d.exr", "--passes", most, "--resume", "c.ckpt"})); // no pass more
    expectPassesOf("d.exr", most);
}

struct BadDevice {
    const char *queue, *how, *at, *message;
};

class BadDevices : public SharedRenderTest, public testing::WithParamInterface<BadDevice> {};

TEST_P(BadDevices, AreDroppedAndTheirPassesRenderedByOthers) {
    const BadDevice bad = GetParam();
    // The second must have failed before the first has rendered all.
    const std::string passes = std::string(bad.queue) == "2" ? "2400" : "400";
    const std::string patience = std::string(bad.how) == "silent" ? "3" : "60"; // a busy machine is no bad device
    const Outcome outcome =
        runBad(shared({"-o", "a.exr", "--passes", passes, "--device-timeout", patience, "--stats", "a.json"}),
               {{"QUASILUX_BAD_QUEUE", bad.queue}, {"QUASILUX_BAD_HOW", bad.how}, {"QUASILUX_BAD_AT", bad.at}});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr(" is dropped"));
    EXPECT_THAT(outcome.errors, HasSubstr(bad.message));
    const auto summary = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(std::to_string(summary.at("passes").get<unsigned>()), passes);
    EXPECT_EQ(summary.at("failure"), nullptr);
    EXPECT_EQ(nlohmann::json::parse(readText(folder / "a.json")).at("stop").at("failure"), nullptr);
    expectPassesOf("a.exr", passes);
}

INSTANTIATE_TEST_SUITE_P(
    OfTwo, BadDevices,
    testing::Values(BadDevice{"2", "build", "1", "do not build on device"},
                    BadDevice{"2", "memory", "1", "OpenCL error -4"}, BadDevice{"2", "lost", "60", "OpenCL error -5"},
                    BadDevice{"2", "silent", "60", "no answer for"}, BadDevice{"2", "nan", "1", "not finite"},
                    BadDevice{"1", "build", "1", "do not build on device"}, // it cannot even learn
                    BadDevice{"1", "lost", "150", "OpenCL error -5"}, BadDevice{"1", "lost", "1500", "OpenCL error -5"},
                    BadDevice{"1", "silent", "1500", "no answer for"}),
    [](const auto& test) { return std::string(test.param.how) + "_" + test.param.queue + "_" + test.param.at; });

// One that is still being opened is not waited for, as that may take for ever.
TEST_F(SharedRenderTest, ImageDoesNotWaitForDevicesThatAreOpened) {
    const Variables bad{{"QUASILUX_BAD_QUEUE", "2"}, {"QUASILUX_BAD_HOW", "silent"}, {"QUASILUX_BAD_AT", "1"}};
    const Outcome outcome =
        endWithin(120, startWith(QUASILUX_BAD_DEVICE, shared({"-o", "a.exr", "--passes", "20"}), bad));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.errors, Not(HasSubstr(" is dropped")));
    EXPECT_EQ(nlohmann::json::parse(outcome.output).at("workers").size(), 1u); // control: it was never opened
    expectPassesOf("a.exr", "20");
}

// With --strict that is an error, but only once the image is there.
TEST_F(SharedRenderTest, StrictOnesAreWrittenFirst) {
    const auto expectError = [&](const std::string& passes, const Variables& bad) {
        const Outcome outcome = runBad(shared({"-o", "a.exr", "--passes", passes, "--strict", "--quiet"}), bad);
        EXPECT_EQ(outcome.exitCode, 1) << outcome.errors;
        EXPECT_THAT(outcome.errors, HasSubstr(" is dropped"));
        EXPECT_THAT(outcome.errors, HasSubstr("--strict: the warning above is an error; the files have been written"));
        expectPassesOf("a.exr", passes);
    };
    expectError("50", {{"QUASILUX_BAD_QUEUE", "1"}, {"QUASILUX_BAD_HOW", "build"}, {"QUASILUX_BAD_AT", "1"}});
    expectError("2400", {{"QUASILUX_BAD_QUEUE", "2"}, {"QUASILUX_BAD_HOW", "lost"}, {"QUASILUX_BAD_AT", "60"}});
}

// A warning before the first pass is no failure of the device that was being prepared.
TEST_F(SharedRenderTest, StrictEndsBeforePassesAreOfNoDevice) {
    // Two sheets in one place.
    const std::string plate = test::litPlate(8);
    const size_t end = plate.find("</shape>") + 8;
    std::ofstream(folder / "scene.xml")
        << plate.substr(0, end)
        << R"(<shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/><rotate z="1" angle="20"/>
            <translate z="4"/></transform></shape>)"
        << plate.substr(end);
    const std::string said = expectRefused(shared({"--passes", "4", "--strict"}), "nothing is rendered");
    EXPECT_THAT(said, HasSubstr("warning: "));
    EXPECT_THAT(said, Not(HasSubstr(" is dropped")));
}

// The image is that of the passes that are there.
TEST_F(SharedRenderTest, WhereAllFailWhatThereIsIsWritten) {
    const Outcome outcome =
        runBad(shared({"-o", "a.exr", "--time", "60", "--checkpoint", "a.ckpt", "--every", "0"}),
               {{"QUASILUX_BAD_QUEUE", "0"}, {"QUASILUX_BAD_HOW", "lost"}, {"QUASILUX_BAD_SINCE", "a.ckpt.previous"}});
    EXPECT_EQ(outcome.exitCode, 1) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: no device is left; the last one: device 0 part "));
    const auto summary = nlohmann::json::parse(outcome.output);
    EXPECT_NE(summary.at("failure"), nullptr);
    const auto passes = summary.at("passes").get<unsigned>();
    ASSERT_GT(passes, 16u);
    const Checkpoint checkpoint = checkpointOf(CheckpointReader((folder / "a.ckpt").string()));
    if (checkpoint.counters.passes == passes)
        expectPassesOf("a.exr", std::to_string(passes));
    else // some between are missing
        EXPECT_THAT(outcome.errors, HasSubstr("error: no checkpoint of the last passes could be written"));
}

TEST_F(SharedRenderTest, WrongDevicesAreRefused) {
    expectRefused(render({"--device", "0,77"}), "--device 77: no such device");
    expectRefused(render({"--device", "0/900"}), "it cannot be divided into 900 parts");
    expectRefused(shared({"--view"}), "--view shows the passes of one device");
    expectRefused(shared({"--tev"}), "--tev shows the passes of one device");
}

} // namespace
} // namespace quasilux
