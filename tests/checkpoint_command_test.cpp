// Checkpoints by the program from outside: killed at any moment, ended by a scheduler, on a disk that is full; farms
// whose passes are merged (docs/reference/reliability.md).
#include "support/image_difference.h"
#include "support/lit_plate.h"
#include "support/program_runner.h"

#include "compare/image_file.h"
#include "output/render_checkpoint.h"
#include "util/error.h"
#include "util/stopwatch.h"

#include <cmath>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <random>
#include <sys/resource.h>
#include <thread>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Arguments = std::vector<std::string>;

class CheckpointCommand : public CommandLineTest {
protected:
    CheckpointCommand() { writeScene(test::litPlate()); }

    void writeScene(const std::string& text) const { std::ofstream(folder / "scene.xml") << text; }
    Arguments render(const Arguments& more) const {
        Arguments all{"render", "scene.xml", "--photons", "256", "--fixed", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    /// `render` with exit code 0.
    void renderWell(const Arguments& more) const {
        const Outcome outcome = run(render(more));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    }
    Checkpoint checkpoint(const std::string& name) const {
        return checkpointOf(CheckpointReader((folder / name).string()));
    }
    std::vector<float> radianceOf(const std::string& name) const {
        return readRadiance((folder / name).string()).radiance;
    }
    std::vector<float> errorOf(const std::string& name) const {
        return readRadiance((folder / name).string()).standardError;
    }
    void expectSameImage(const std::string& a, const std::string& b) const {
        EXPECT_EQ(radianceOf(a), radianceOf(b));
        EXPECT_EQ(errorOf(a), errorOf(b));
    }
    bool isThere(const std::string& name) const { return fs::exists(folder / name); }

    /// Ends the program after so many milliseconds as no program can know, of its start or of its first checkpoint;
    /// false where it ended before.
    bool runAndKill(const Arguments& arguments, unsigned milliseconds, bool sinceCheckpoint) const {
        const pid_t child = start(arguments);
        const Stopwatch watch;
        while (sinceCheckpoint && !isThere("a.ckpt") && watch.seconds() < 120)
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
        kill(child, SIGKILL);
        return end(child).exitCode == -1;
    }
};

TEST_F(CheckpointCommand, ResumesToTheSameBits) {
    renderWell({"-o", "whole.exr", "--passes", "30"});
    renderWell({"-o", "a.exr", "--passes", "10", "--checkpoint", "a.ckpt"});
    EXPECT_EQ(checkpoint("a.ckpt").counters.passes, 10u);
    renderWell({"-o", "b.exr", "--passes", "30", "--resume", "a.ckpt", "--checkpoint", "a.ckpt"});
    expectSameImage("b.exr", "whole.exr");
    EXPECT_EQ(checkpoint("a.ckpt.previous").counters.passes, 10u); // two are written: at the beginning and at the end
    // No pass more is asked for: the image of those that are there.
    renderWell({"-o", "c.exr", "--passes", "30", "--resume", "a.ckpt"});
    expectSameImage("c.exr", "whole.exr");
    renderWell({"-o", "d.exr", "--resume", "a.ckpt"}); // as it was begun
    expectSameImage("d.exr", "whole.exr");
    EXPECT_NE(radianceOf("a.exr"), radianceOf("whole.exr")); // control
}

// kill -9 at random moments, ten times, of a render that writes a checkpoint after each pass; the first time there is
// one.
TEST_F(CheckpointCommand, SurvivesBeingKilled) {
    std::mt19937 random(24);
    unsigned killed = 0;
    for (unsigned k = 0; k < 10; ++k) {
        Arguments arguments = render({"-o", "a.exr", "--passes", "1000000", "--every", "0", "--checkpoint", "a.ckpt"});
        if (isThere("a.ckpt")) arguments.insert(arguments.end(), {"--resume", "a.ckpt"});
        killed += runAndKill(arguments, std::uniform_int_distribution<unsigned>(200, 1200)(random), k == 0) ? 1 : 0;
        if (isThere("a.ckpt")) checkpoint("a.ckpt"); // throws where it is damaged
    }
    EXPECT_EQ(killed, 10u);
    // Those that were killed while they wrote have left two names at most, of one file each.
    EXPECT_LE(std::distance(fs::directory_iterator(folder), {}), 5); // scene, checkpoint, the one before
    ASSERT_TRUE(isThere("a.ckpt"));
    const auto passes = static_cast<unsigned>(checkpoint("a.ckpt").counters.passes) + 5;
    ASSERT_GT(passes, 5u);
    renderWell({"-o", "a.exr", "--passes", std::to_string(passes), "--resume", "a.ckpt"});
    renderWell({"-o", "whole.exr", "--passes", std::to_string(passes)});
    expectSameImage("a.exr", "whole.exr");
}

// What a scheduler does before it kills: nothing is lost, and the code says that it is not done.
TEST_F(CheckpointCommand, IsWrittenOnSigterm) {
    const auto rendersForASecond = [&, since = std::optional<Stopwatch>()]() mutable {
        if (!since && isThere("a.ckpt")) since.emplace(); // the first checkpoint is written as rendering begins
        return since && since->seconds() > 1;
    };
    const Outcome outcome =
        runUntil(render({"-o", "a.exr", "--time", "500", "--checkpoint", "a.ckpt"}), rendersForASecond, SIGTERM);
    ASSERT_EQ(outcome.exitCode, 128 + SIGTERM) << outcome.errors;
    ASSERT_TRUE(isThere("a.ckpt"));
    const auto passes = nlohmann::json::parse(outcome.output).at("passes").get<unsigned>();
    EXPECT_EQ(checkpoint("a.ckpt").counters.passes, passes);
    renderWell({"-o", "b.exr", "--passes", std::to_string(passes + 3), "--resume", "a.ckpt"});
    renderWell({"-o", "whole.exr", "--passes", std::to_string(passes + 3)});
    expectSameImage("b.exr", "whole.exr");
}

// What the search chose is part of the checkpoint, whatever the clock would say the next time.
TEST_F(CheckpointCommand, KeepsWhatWasSearched) {
    const Arguments searched{"render", "scene.xml", "--json", "-o", "a.exr"};
    const auto with = [&](const Arguments& more) {
        Arguments all = searched;
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    const Outcome first = with({"--time", "5", "--checkpoint", "a.ckpt"});
    ASSERT_EQ(first.exitCode, 0) << first.errors;
    const Checkpoint before = checkpoint("a.ckpt");
    const auto passes = std::to_string(before.counters.passes + 2);
    const Outcome second = with({"--passes", passes, "--resume", "a.ckpt", "--checkpoint", "b.ckpt"});
    ASSERT_EQ(second.exitCode, 0) << second.errors;
    const Checkpoint after = checkpoint("b.ckpt");
    EXPECT_EQ(after.counters.passes, before.counters.passes + 2);
    EXPECT_EQ(describe(after).at("settings"), describe(before).at("settings"));
    EXPECT_EQ(after.search.line(), before.search.line());
    EXPECT_EQ(nlohmann::json::parse(second.output).at("auto"), nlohmann::json::parse(first.output).at("auto"));
}

TEST_F(CheckpointCommand, OtherRendersAreRefused) {
    renderWell({"-o", "a.exr", "--passes", "3", "--checkpoint", "a.ckpt"});
    expectRefused(render({"--resume", "a.ckpt", "--bdd", "1"}), "made with other settings: bdd is 0 there, 1 here");
    expectRefused(render({"--resume", "a.ckpt", "--seed", "9"}), "seed is 1 there, 9 here");
    expectRefused(render({"--resume", "none.ckpt"}), "cannot be read");
    expectRefused(render({"--resume", "a.exr"}), "is no checkpoint");
    expectRefused(render({"--resume", "a.ckpt", "--passes", "2:9"}), "it begins with pass 0");
    expectRefused(render({"--checkpoint", "a.ckpt"}),
                  "there is a checkpoint already: go on from it by --resume a.ckpt");
    expectRefused(render({"--checkpoint", "b.txt"}), "expected a name that ends in .ckpt");
    expectRefused(render({"--every", "5"}), "--every requires --checkpoint");
    writeScene(test::litPlate(4, "0.51"));
    expectRefused(render({"--resume", "a.ckpt"}),
                  "the scene is another one, it differs in: materials, textures or emitters");
    writeScene(test::litPlate(5));
    expectRefused(render({"--resume", "a.ckpt"}), "the scene is another one, it differs in: camera, film or depth");
    writeScene(test::litPlate() + "<!-- a comment is no other scene -->\n");
    renderWell({"-o", "b.exr", "--passes", "4", "--resume", "a.ckpt"});
    fs::resize_file(folder / "a.ckpt", 5000);
    expectRefused(render({"--resume", "a.ckpt"}), "its checksum is wrong");
}

// Names of files are bytes; those of a checkpoint's description are text.
TEST_F(CheckpointCommand, ASceneMayHaveAnyName) {
    const std::string name = "caf\xe9.xml";
    fs::rename(folder / "scene.xml", folder / name);
    const Arguments begin{"render", name, "--photons", "256", "--fixed", "--json"};
    const auto with = [&](const Arguments& more) {
        Arguments all = begin;
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = run(all);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    };
    with({"-o", "a.exr", "--passes", "4", "--checkpoint", "a.ckpt"});
    with({"-o", "b.exr", "--passes", "8", "--resume", "a.ckpt"});
    with({"-o", "whole.exr", "--passes", "8"});
    expectSameImage("b.exr", "whole.exr");
}

// From pass 16 on four passes are one batch, whose scatter is that of nothing.
TEST_F(CheckpointCommand, AnErrorFromOneBatchIsNotKnown) {
    const auto errorAfter = [&](const std::string& passes) {
        const Outcome outcome = run(render({"-o", "a.exr", "--passes", passes}));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return nlohmann::json::parse(outcome.output).at("relativeError");
    };
    for (const char* passes : {"1", "100:104"}) {
        EXPECT_TRUE(errorAfter(passes).is_null()) << passes;
        EXPECT_TRUE(errorOf("a.exr").empty()) << passes;
    }
    EXPECT_GT(errorAfter("100:108").get<double>(), 0);
    EXPECT_FALSE(errorOf("a.exr").empty());
}

// A limit on files stands for the disk: the checkpoint does not fit, the image does.
TEST_F(CheckpointCommand, FullDiskLosesNoImage) {
    writeScene(test::litPlate(128));
    renderWell({"-o", "whole.exr", "--passes", "6"});
    renderWell({"-o", "a.exr", "--passes", "4", "--checkpoint", "a.ckpt"});
    const std::string good = readText(folder / "a.ckpt");
    constexpr uint64_t small = 4 << 20; // holds what the OpenCL runtime writes while it compiles, too
    ASSERT_LT(small, good.size());
    ASSERT_GT(small, fs::file_size(folder / "whole.exr"));
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit full{small, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &full);
    const Outcome outcome =
        run(render({"-o", "b.exr", "--passes", "6", "--resume", "a.ckpt", "--checkpoint", "a.ckpt", "--every", "0"}));
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.errors, HasSubstr("warning: no checkpoint could be written, the render goes on"));
    EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: no checkpoint of the last passes could be written"));
    EXPECT_THAT(outcome.errors, HasSubstr("File too large"));
    expectSameImage("b.exr", "whole.exr");
    EXPECT_EQ(readText(folder / "a.ckpt"), good);
    for (const auto& entry : fs::directory_iterator(folder)) EXPECT_NE(entry.path().extension(), ".tmp");
}

// A file system without hard links cannot keep both: the older one gives up its name only when the new one is on the
// disk, and where the program ends just then, the render goes on from what there is.
TEST_F(CheckpointCommand, WithoutLinksNoneIsLost) {
    renderWell({"-o", "a.exr", "--passes", "4", "--checkpoint", "a.ckpt"});
    const std::string good = readText(folder / "a.ckpt");
    const Arguments resumed = render({"-o", "b.exr", "--passes", "6", "--resume", "a.ckpt", "--checkpoint", "a.ckpt"});
    const Outcome failed =
        runWith(QUASILUX_FAILING_CALLS, resumed,
                {{"QUASILUX_NO_LINKS", "1"}, {"QUASILUX_FAIL_CALL", "fsync"}, {"QUASILUX_FAIL_AT", "-1"}});
    EXPECT_EQ(failed.exitCode, 1);
    ASSERT_TRUE(isThere("a.ckpt"));
    EXPECT_EQ(readText(folder / "a.ckpt"), good);
    fs::rename(folder / "a.ckpt", folder / "a.ckpt.previous");
    expectRefused(render({"--checkpoint", "a.ckpt"}),
                  "there is a checkpoint already: go on from it by --resume a.ckpt, or remove a.ckpt.previous first");
    const Outcome outcome = run(resumed);
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_THAT(outcome.errors, HasSubstr("--resume a.ckpt: is not there, it goes on from a.ckpt.previous"));
    EXPECT_EQ(checkpoint("a.ckpt").counters.passes, 6u);
}

// The other kinds of renders: camera points stored, and a grid, of which there is a table.
TEST_F(CheckpointCommand, OtherKindsResumeToTheSameBits) {
    const auto renders = [&](const Arguments& kind, const Arguments& more) {
        Arguments all = kind;
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = run(all);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    };
    const Arguments points = render({"--map", "camera"});
    renders(points, {"-o", "whole.exr", "--passes", "9"});
    renders(points, {"-o", "a.exr", "--passes", "4", "--checkpoint", "points.ckpt"});
    renders(points, {"-o", "b.exr", "--passes", "9", "--resume", "points.ckpt"});
    expectSameImage("b.exr", "whole.exr");
    writeScene(test::litPlate().insert(test::litPlate().find("</scene>"),
                                       "<?quasilux illuminance-grid origin=\"-1,-1,3.9\" edge-u=\"1,0,0\" "
                                       "edge-v=\"0,1,0\" nx=\"3\" ny=\"2\"?>"));
    const Arguments grid{"render", "scene.xml", "--fixed", "--photons", "2000", "--json"};
    renders(grid, {"--grid", "whole.csv", "--passes", "9"});
    renders(grid, {"--grid", "a.csv", "--passes", "4", "--checkpoint", "grid.ckpt"});
    renders(grid, {"--grid", "b.csv", "--passes", "9", "--resume", "grid.ckpt"});
    const auto table = [&](const std::string& name) { // without the header, which says how long it took
        const std::string text = readText(folder / name);
        return text.substr(text.find("\ni,j,"));
    };
    EXPECT_EQ(table("b.csv"), table("whole.csv"));
    EXPECT_NE(table("a.csv"), table("whole.csv")); // control
}

// A render that searches its settings for minutes is ended early, in the search or before it: nothing half written is
// left.
TEST_F(CheckpointCommand, SearchThatIsKilledLeavesNoHalfCheckpoint) {
    const Arguments searched{"render", "scene.xml", "-o", "a.exr", "--time", "1000", "--checkpoint", "a.ckpt"};
    const Outcome outcome = run(searched, 5, SIGTERM);
    // While the device is opened on a busy machine: by the signal itself.
    EXPECT_THAT(outcome.exitCode, testing::AnyOf(128 + SIGTERM, -1)) << outcome.errors;
    // One is written before the first pass, when there is no image yet. Reading throws where it is damaged.
    const bool hasPasses = isThere("a.ckpt") && !checkpoint("a.ckpt").passes.empty();
    EXPECT_EQ(isThere("a.exr"), hasPasses);
    for (const auto& entry : fs::directory_iterator(folder)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST_F(CheckpointCommand, MergesPassesOfAFarm) {
    renderWell({"-o", "whole.exr", "--passes", "24"});
    renderWell({"-o", "a.exr", "--passes", "0:16", "--checkpoint", "a.ckpt"});
    renderWell({"-o", "b.exr", "--passes", "16:24", "--checkpoint", "b.ckpt"});
    const Outcome merged =
        run({"merge", "b.ckpt", "a.ckpt", "-o", "all.exr", "--png", "all.png", "--checkpoint", "all.ckpt", "--json"});
    ASSERT_EQ(merged.exitCode, 0) << merged.errors;
    EXPECT_EQ(nlohmann::json::parse(merged.output).at("passRanges"), nlohmann::json::parse("[[0, 24]]"));
    EXPECT_LT(largestDifference(radianceOf("all.exr"), radianceOf("whole.exr")), 1.2e-7);
    EXPECT_GT(largestDifference(radianceOf("a.exr"), radianceOf("whole.exr")), 1e-4); // control
    EXPECT_TRUE(isThere("all.png"));
    renderWell({"-o", "more.exr", "--passes", "28", "--resume", "all.ckpt"});
    renderWell({"-o", "whole.exr", "--passes", "28"});
    EXPECT_LT(largestDifference(radianceOf("more.exr"), radianceOf("whole.exr")), 1.2e-7);
    expectRefused({"merge", "a.ckpt", "all.ckpt", "-o", "x.exr"},
                  "both have passes 0 to 15: each pass may be there once");
    expectRefused({"merge", "a.ckpt", "b.ckpt", "--checkpoint", "./a.ckpt"}, "would be replaced");
    expectRefused({"merge", "a.ckpt", "b.ckpt"}, "nothing to write, expected --output, --png or --checkpoint");
    expectRefused({"merge", "-o", "x.exr"}, "CHECKPOINT is required");
}

// Alpha takes the scene: a merge says that it has none, and where there is.
TEST_F(CheckpointCommand, MergeSaysWhatItLeavesOut) {
    std::string scene = test::litPlate();
    const std::string film = R"(type="hdrfilm">)";
    writeScene(scene.insert(scene.find(film) + film.size(), R"(<string name="pixel_format" value="rgba"/>)"));
    renderWell({"-o", "a.exr", "--passes", "0:4", "--checkpoint", "a.ckpt"});
    renderWell({"-o", "b.exr", "--passes", "4:8", "--checkpoint", "b.ckpt"});
    const Outcome merged = run({"merge", "a.ckpt", "b.ckpt", "-o", "all.exr", "--checkpoint", "all.ckpt"});
    EXPECT_EQ(merged.exitCode, 0);
    EXPECT_THAT(merged.errors, HasSubstr("warning: --output all.exr: without the layers A, which take the scene"));
    renderWell({"-o", "with.exr", "--passes", "8", "--resume", "all.ckpt"});
    expectSameImage("with.exr", "all.exr");
}

// Of an image in W per nanometre lux are 107 times too low: tools that warn of it must know of a merged one, too.
TEST_F(CheckpointCommand, MergeKeepsTheUnit) {
    std::string scene = test::litPlate();
    writeScene(scene.insert(scene.find("</scene>"), R"(<emitter type="sunsky"/>)"));
    renderWell({"-o", "a.exr", "--passes", "0:4", "--checkpoint", "a.ckpt"});
    renderWell({"-o", "b.exr", "--passes", "4:8", "--checkpoint", "b.ckpt"});
    const Outcome merged = run({"merge", "a.ckpt", "b.ckpt", "-o", "all.exr", "--checkpoint", "all.ckpt"});
    EXPECT_EQ(merged.exitCode, 0) << merged.errors;
    EXPECT_EQ(run({"merge", "all.ckpt", "-o", "again.exr"}).exitCode, 0);
    for (const char* image : {"a.exr", "all.exr", "again.exr"})
        EXPECT_THAT(run({"falsecolour", image, "-o", "f.png"}).errors, HasSubstr("is in W per nanometre")) << image;
}

// The example of the documents, its array as a loop; each task twice, the second time as one that is requeued.
TEST_F(CheckpointCommand, ExampleOfASlurmArrayRuns) {
    const std::string text = readText(QUASILUX_SOURCE_DIR "/docs/reference/reliability.md");
    const auto begin = text.find("#!/bin/bash\n#SBATCH"), end = text.find("```", begin);
    ASSERT_NE(begin, std::string::npos);
    std::ofstream(folder / "array.sh") << text.substr(begin, end - begin);
    fs::create_directory(folder / "parts");
    const std::string program = fs::path(QUASILUX_PROGRAM).parent_path().string();
    const std::string command =
        "cd '" + folder.string() + "' && export PATH='" + program + "':$PATH && for task in 0 1 2 0; do " +
        "SLURM_ARRAY_TASK_ID=$task PASSES=4 bash array.sh >/dev/null 2>errors.txt || exit 1; done && " +
        "quasilux merge parts/*.ckpt -o all.exr --quiet";
    ASSERT_EQ(std::system(command.c_str()), 0) << readText(folder / "errors.txt");
    const Outcome whole = run({"render", "scene.xml", "--passes", "12", "-o", "whole.exr"});
    EXPECT_EQ(whole.exitCode, 0) << whole.errors;
    EXPECT_LT(largestDifference(radianceOf("all.exr"), radianceOf("whole.exr")), 1.2e-7);
}

} // namespace
} // namespace quasilux
