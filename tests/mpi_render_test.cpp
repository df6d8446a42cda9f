// Renders as jobs of several ranks, with mpirun (docs/reference/reliability.md, "Machines"). A program without MPI
// refuses to be one (job_alone_test).
#include "support/lit_plate.h"
#include "support/program_runner.h"

#include "compare/image_file.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using testing::HasSubstr;

#ifndef QUASILUX_MPIRUN

TEST_F(CommandLineTest, WithoutMpiSeveralRanksAreRefused) {
    setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
    setenv("OMPI_COMM_WORLD_RANK", "0", 1);
    const Outcome outcome = run({"render", "scene.xml", "--passes", "1"});
    unsetenv("OMPI_COMM_WORLD_SIZE");
    unsetenv("OMPI_COMM_WORLD_RANK");
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.errors, HasSubstr("started as rank 0 of 2, but built without MPI"));
}

#else

class MpiRenderTest : public CommandLineTest {
protected:
    MpiRenderTest() { std::ofstream(folder / "scene.xml") << test::litPlate(32); }

    /// So many ranks, each with its part of device 0; `before`: of the shell, before mpirun.
    Outcome runRanks(unsigned ranks, const std::string& arguments, const std::string& before = "") const {
        const std::string device = ranks == 1 ? "" : " --device 0/2";
        const std::string command =
            "cd '" + folder.string() + "' && " + before +
            " " QUASILUX_MPIRUN " --allow-run-as-root --oversubscribe --mca odls_base_sigkill_timeout 4 -n " +
            std::to_string(ranks) + " '" QUASILUX_PROGRAM "' render scene.xml " + "--photons 40000 --fixed" + device +
            " " + arguments + " >'" + (root / "out").string() + "' 2>'" + (root / "err").string() + "'";
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), readText(root / "out"), readText(root / "err")};
    }
    void expectSameImage(const std::string& a, const std::string& b) const {
        const auto one = readRadiance((folder / a).string()).radiance,
                   other = readRadiance((folder / b).string()).radiance;
        ASSERT_EQ(one.size(), other.size());
        for (size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], other[k], 1.2e-7 * std::abs(other[k]));
    }
};

TEST_F(MpiRenderTest, IsTheSumOfTheSamePasses) {
    run({"render", "scene.xml", "--photons", "40000", "--fixed", "--passes", "200", "-o", "whole.exr"});
    for (const unsigned ranks : {1u, 2u}) {
        const Outcome job = runRanks(ranks, "--passes 200 -o a.exr --json");
        ASSERT_EQ(job.exitCode, 0) << job.errors;
        const auto summary = nlohmann::json::parse(job.output); // one rank alone has spoken
        EXPECT_EQ(summary.at("passes"), 200);
        expectSameImage("a.exr", "whole.exr");
        if (ranks == 1) continue;
        ASSERT_EQ(summary.at("workers").size(), 2u);
        EXPECT_THAT(summary.at("workers")[1].at("name"), HasSubstr("rank 1 on "));
        EXPECT_GT(summary.at("workers")[1].at("passes"), 0) << summary;
    }
}

// As a scheduler does that asks first: mpirun waits as long before and after it passes SIGTERM on.
TEST_F(MpiRenderTest, KeepsItsCheckpointOnAnEndingSignal) {
    // Kernels may have to be compiled first: the signal is sent once a checkpoint is there, however long that takes.
    const char* const endOnceKept = "endOnceKept() { \"$@\" & job=$!; "
                                    "while [ ! -s a.ckpt ] && kill -0 $job; do sleep 0.1; done; "
                                    "sleep 1; kill -TERM $job; wait $job; }; endOnceKept";
    const Outcome ended = runRanks(2, "--time 500 --checkpoint a.ckpt --every 1 -o a.exr --json", endOnceKept);
    EXPECT_NE(ended.exitCode, 0);
    ASSERT_TRUE(std::filesystem::exists(folder / "a.exr")) << ended.errors;
    const auto passes = nlohmann::json::parse(ended.output).at("passes").get<unsigned>();
    ASSERT_GT(passes, 16u);
    const std::string more = std::to_string(passes + 40);
    const Outcome resumed = runRanks(2, "--passes " + more + " --resume a.ckpt -o b.exr --quiet");
    ASSERT_EQ(resumed.exitCode, 0) << resumed.errors;
    run({"render", "scene.xml", "--photons", "40000", "--fixed", "--passes", more, "-o", "whole.exr"});
    expectSameImage("b.exr", "whole.exr");
}

TEST_F(MpiRenderTest, ErrorsAreSaidOnce) {
    const Outcome job = runRanks(2, "--passes 4 -D gone=1 -o gone/a.exr");
    EXPECT_EQ(job.exitCode, 2) << job.errors;
    const std::string message = "quasilux: error: --output gone/a.exr: folder gone does not exist";
    const auto first = job.errors.find(message);
    ASSERT_NE(first, std::string::npos) << job.errors;
    EXPECT_EQ(job.errors.find(message, first + 1), std::string::npos);
}

// A rank whose device is lost is dropped; its passes are rendered by the other.
TEST_F(MpiRenderTest, RanksWithBadDevicesAreDropped) {
    run({"render", "scene.xml", "--photons", "40000", "--fixed", "--passes", "200", "-o", "whole.exr"});
    std::ofstream(folder / "bad.sh")
        << "#!/bin/bash\n[[ $OMPI_COMM_WORLD_RANK == 1 ]] && export LD_PRELOAD=" QUASILUX_BAD_DEVICE
           " QUASILUX_BAD_QUEUE=1 QUASILUX_BAD_HOW=lost QUASILUX_BAD_AT=200\nexec \"$@\"\n";
    const std::string command =
        "cd '" + folder.string() + "' && " QUASILUX_MPIRUN " --allow-run-as-root --oversubscribe -n 2 " +
        "bash bad.sh '" QUASILUX_PROGRAM "' render scene.xml --photons 40000 --fixed --device 0/2 " +
        "--passes 200 -o a.exr >out 2>err";
    ASSERT_EQ(std::system(command.c_str()), 0) << readText(folder / "err");
    EXPECT_THAT(readText(folder / "err"), HasSubstr("device 0 part 2 of 2 is dropped"));
    expectSameImage("a.exr", "whole.exr");
}

#endif

} // namespace
} // namespace quasilux
