// Signals that come twice (docs/reference/command-line.md#exit-codes): by one cause, which must not cost the image, or
// by somebody who does not want to wait. A device that gives no answer (shims/bad_device.cpp) keeps the program from
// ending by itself.
#include "support/lit_plate.h"
#include "support/program_runner.h"

#include "util/stopwatch.h"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace quasilux {
namespace {

namespace fs = std::filesystem;

class InterruptTest : public CommandLineTest {
protected:
    InterruptTest() { std::ofstream(folder / "scene.xml") << test::litPlate(); }

    void removeOutputs() const {
        for (const char* name : {"a.ckpt", "a.ckpt.previous", "a.exr"}) fs::remove(folder / name);
    }
    /// "a.ckpt" is there before the first pass, "a.ckpt.previous" after it.
    void waitFor(const char* name) const {
        const Stopwatch watch;
        while (!fs::exists(folder / name) && watch.seconds() < 120) usleep(20000);
        ASSERT_TRUE(fs::exists(folder / name)) << readText(root / "stderr");
    }
    static std::vector<std::string> endless(const std::string& photons) {
        return {"render", "scene.xml",    "-o",     "a.exr",   "--time", "500",       "--fixed",
                "--json", "--checkpoint", "a.ckpt", "--every", "0",      "--photons", photons};
    }
    /// Of a render that never ends by itself: the exit code after two signals `pause` seconds apart; -1: it went on for
    /// `seconds` more.
    int codeAfterTwo(int signal, unsigned pause, double seconds) const {
        removeOutputs();
        const pid_t process =
            startWith(QUASILUX_BAD_DEVICE, endless("256"),
                      {{"QUASILUX_BAD_QUEUE", "1"}, {"QUASILUX_BAD_HOW", "silent"}, {"QUASILUX_BAD_SINCE", "a.ckpt"}});
        waitFor("a.ckpt");
        usleep(500000);
        kill(process, signal);
        sleep(pause);
        kill(process, signal);
        return endWithin(seconds, process).exitCode;
    }
};

// The shell and the kernel both say that a terminal is gone, `timeout -s INT` sends its signal to the program and to
// its group; a pass takes longer than the time between.
TEST_F(InterruptTest, TwoOfOneCauseAreOne) {
    for (const int signal : {SIGHUP, SIGTERM, SIGINT}) {
        removeOutputs();
        const pid_t process = start(endless("2000000"));
        waitFor("a.ckpt.previous");
        kill(process, signal);
        usleep(50000);
        kill(process, signal == SIGINT ? SIGINT : SIGHUP);
        const Outcome outcome = end(process);
        EXPECT_EQ(outcome.exitCode, signal == SIGINT ? 0 : 128 + signal) << outcome.errors;
        ASSERT_TRUE(fs::exists(folder / "a.exr")) << outcome.errors;
        EXPECT_EQ(nlohmann::json::parse(outcome.output).at("interrupted"), true);
    }
}

TEST_F(InterruptTest, ASecondOneEndsItAtOnce) {
    EXPECT_EQ(codeAfterTwo(SIGINT, 1, 60), 128 + SIGINT);
    EXPECT_EQ(codeAfterTwo(SIGTERM, 3, 60), 128 + SIGTERM);
    EXPECT_EQ(codeAfterTwo(SIGTERM, 0, 5), -1);
}

} // namespace
} // namespace quasilux
