// Each call of OpenCL, of a file and of operator new fails once (shims/failing_calls.cpp) in a small render with every
// kind of output: what failed is named, the exit code is the documented one, no file is half written, and an image that
// is there is right. Here the middle call of each function, or the one that QUASILUX_FAULTS says: `all`, or a number of
// calls spread evenly (scripts/faults.sh).
#include "support/program_runner.h"

#include "compare/image_file.h"
#include "output/render_checkpoint.h"
#include "util/error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

namespace quasilux {
namespace {

namespace fs = std::filesystem;

using Arguments = std::vector<std::string>;

constexpr unsigned passes = 3;
// A mesh from a file; what photons serve; little to compile.
constexpr const char* plate = R"(<scene version="3.0.0">
  <sensor type="perspective"><float name="fov" value="40"/>
    <film type="hdrfilm"><integer name="width" value="4"/><integer name="height" value="4"/></film></sensor>
  <shape type="obj"><string name="filename" value="plate.obj"/></shape>
  <emitter type="point"><point name="position" x="0" y="2" z="2"/></emitter>
</scene>
)";

class FaultsTest : public CommandLineTest {
protected:
    FaultsTest() {
        std::ofstream(folder / "scene.xml") << plate;
        std::ofstream(folder / "plate.obj") << "v -1 -1 4\nv -1 1 4\nv 1 1 4\nv 1 -1 4\nf 1 2 3 4\n";
        static const auto images = rightImages();
        images_ = images;
    }

    /// By the number of passes.
    std::map<unsigned, std::vector<float>> rightImages() const {
        std::map<unsigned, std::vector<float>> images;
        for (unsigned pass = 1; pass <= passes; ++pass) {
            const Outcome outcome = run(render(pass, "whole.exr"));
            EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
            images[pass] = radianceOf("whole.exr");
        }
        clean();
        return images;
    }

    static Arguments render(unsigned pass, const std::string& image) {
        return {"render",    "scene.xml", "--fixed", "--radius", "fixed",    "--emission",         "plain",
                "--photons", "64",        "-o",      image,      "--passes", std::to_string(pass), "--json"};
    }
    static Arguments allOutputs() {
        Arguments arguments = render(passes, "a.exr");
        const Arguments more{"--png", "a.png", "--stats", "a.json", "--checkpoint", "a.ckpt", "--every", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    std::vector<float> radianceOf(const std::string& name) const {
        return readRadiance((folder / name).string()).radiance;
    }

    /// Removes what a run has written.
    void clean() const {
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().filename() != "scene.xml" && entry.path().filename() != "plate.obj")
                fs::remove_all(entry.path());
    }

    Outcome runFailing(const Arguments& arguments, const Variables& variables) const {
        return runWith(QUASILUX_FAILING_CALLS, arguments, variables);
    }

    using Counts = std::map<std::string, unsigned>;

    /// Of a run without a fault.
    Counts countCalls(const Arguments& arguments) const {
        const Outcome outcome = runFailing(arguments, {{"QUASILUX_COUNT_CALLS", countFile.string()}});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return readCounts();
    }
    Counts readCounts() const {
        Counts counts;
        std::ifstream stream(countFile);
        std::string name;
        for (unsigned count = 0; stream >> name >> count;) counts[name] = count;
        return counts;
    }

    /// Objects of OpenCL that are there when a run ends, by kind. A call that has failed has made none, or given none back.
    static std::map<std::string, int64_t> objectsLeft(const Counts& counts, const std::string& failed = "") {
        std::map<std::string, int64_t> left;
        for (const auto& [object, maker] : {std::pair("Context", "clCreateContext"),
                                            {"CommandQueue", "clCreateCommandQueue"},
                                            {"MemObject", "clCreateBuffer"},
                                            {"Program", "clCreateProgramWithSource"},
                                            {"Kernel", "clCreateKernel"},
                                            {"Event", "clEnqueueNDRangeKernel"}}) {
            const std::string retain = std::string("clRetain") + object, release = std::string("clRelease") + object;
            left[object] = int64_t(counts.at(maker)) + counts.at(retain) - counts.at(release);
            if (failed == maker || failed == retain) --left[object];
        }
        return left;
    }

    /// Everything in the folder is whole; the image is that of as many passes as the render says.
    void expectWholeFiles(const Outcome& outcome) const {
        const std::set<std::string> known{"scene.xml", "plate.obj", "a.exr",          "a.png",
                                          "a.json",    "a.ckpt",    "a.ckpt.previous"};
        for (const auto& entry : fs::directory_iterator(folder))
            EXPECT_TRUE(known.contains(entry.path().filename())) << entry.path();
        unsigned pass = passes;
        if (const auto summary = nlohmann::json::parse(outcome.output, nullptr, false); summary.is_object())
            pass = summary.at("passes").get<unsigned>();
        if (fs::exists(folder / "a.exr")) {
            const auto radiance = radianceOf("a.exr");
            EXPECT_TRUE(
                std::any_of(images_.begin(), images_.end(), [&](const auto& each) { return each.second == radiance; }));
            if (!outcome.output.empty()) {
                EXPECT_EQ(radiance, images_.at(pass));
            }
        }
        if (fs::exists(folder / "a.png")) {
            EXPECT_TRUE(readText(folder / "a.png").ends_with("IEND\xae\x42\x60\x82"));
        }
        if (fs::exists(folder / "a.json")) {
            EXPECT_TRUE(nlohmann::json::accept(readText(folder / "a.json")));
        }
        for (const char* checkpoint : {"a.ckpt", "a.ckpt.previous"})
            if (fs::exists(folder / checkpoint)) {
                EXPECT_NO_THROW(checkpointOf(CheckpointReader((folder / checkpoint).string()))) << checkpoint;
            }
    }

    /// Whether the message says what failed: of OpenCL the function and the error's number, of files the name, of
    /// memory that.
    static bool names(const std::string& call, const std::string& errors) {
        const auto has = [&](const char* pattern) { return std::regex_search(errors, std::regex(pattern)); };
        if (call.rfind("cl", 0) == 0)
            return has("OpenCL error -[0-9]+|do not build on device") && has("kernel|buffer|device|cl[A-Z][A-Za-z]+");
        if (call == "new") return has("memory");
        return has("a\\.(exr|png|json|ckpt)|begun\\.ckpt|scene\\.xml|plate\\.obj");
    }

    /// What a run gives back without a fault, it gives back with one, or tries to.
    void expectNothingLeft(const std::string& call) const {
        const auto counts = readCounts();
        ASSERT_FALSE(counts.empty());
        for (const auto& [object, left] : objectsLeft(counts, call)) EXPECT_LE(left, leftWithout_.at(object)) << object;
    }

    void expectGoodEnd(const std::string& call, unsigned at, const Arguments& arguments) {
        SCOPED_TRACE(call + ", call " + std::to_string(at));
        fs::remove(countFile);
        const Outcome outcome = runFailing(arguments, {{"QUASILUX_FAIL_CALL", call},
                                                       {"QUASILUX_FAIL_AT", std::to_string(at)},
                                                       {"QUASILUX_COUNT_CALLS", countFile.string()}});
        expectNothingLeft(call);
        // 0: what failed was not needed, or was tried again. 2: a file that cannot be read is bad input.
        EXPECT_THAT(outcome.exitCode, testing::AnyOf(0, 1, 2)) << outcome.errors;
        if (outcome.exitCode != 0) {
            EXPECT_THAT(outcome.errors, testing::HasSubstr("quasilux: error: "));
            EXPECT_TRUE(names(call, outcome.errors)) << outcome.errors;
        } else {
            EXPECT_TRUE(fs::exists(folder / "a.exr"));
        }
        expectWholeFiles(outcome);
        ++ends_[outcome.exitCode];
        clean();
    }

    /// Of `count` calls those that fail, one at a time.
    static std::vector<unsigned> chosen(unsigned count) {
        const char* const wish = std::getenv("QUASILUX_FAULTS");
        const unsigned most = !wish ? 1 : std::string(wish) == "all" ? count : static_cast<unsigned>(std::stoul(wish));
        std::vector<unsigned> calls;
        const unsigned parts = std::min(most, count);
        for (unsigned k = 0; k < parts; ++k)
            calls.push_back(1 + static_cast<unsigned>((uint64_t(2) * k + 1) * count / (uint64_t(2) * parts)) % count);
        return calls;
    }

    std::map<unsigned, std::vector<float>> images_; ///< by the number of passes
    std::map<int, unsigned> ends_;                  ///< by exit code
    std::map<std::string, int64_t> leftWithout_;    ///< objectsLeft() without a fault
    const fs::path countFile = root / "counts";
};

TEST_F(FaultsTest, NoneLosesWhatIsThere) {
    const auto counts = countCalls(allOutputs());
    clean();
    leftWithout_ = objectsLeft(counts);
    ASSERT_GT(counts.at("clEnqueueNDRangeKernel"), passes);
    for (const auto& [call, count] : counts)
        for (const unsigned at : chosen(count)) expectGoodEnd(call, at, allOutputs());
    // Control: most calls are needed.
    EXPECT_GT(ends_[1], 10u);
}

// Each file that is there is whole, and all that could be written are.
TEST_F(FaultsTest, OneFileThatFailsLosesNoOther) {
    Arguments arguments = render(passes, "a.exr");
    arguments.insert(arguments.end(), {"--png", "a.png", "--stats", "a.json"});
    const std::vector<std::string> files{"a.exr", "a.png", "a.json"};
    for (size_t k = 0; k < files.size(); ++k) {
        const Outcome outcome =
            runFailing(arguments, {{"QUASILUX_FAIL_CALL", "rename"}, {"QUASILUX_FAIL_AT", std::to_string(k + 1)}});
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_THAT(outcome.errors, testing::HasSubstr("cannot write " + files[k]));
        for (const std::string& file : files) EXPECT_EQ(fs::exists(folder / file), file != files[k]) << file;
        expectWholeFiles(outcome);
        clean();
    }
    const Outcome all = runFailing(arguments, {{"QUASILUX_FAIL_CALL", "rename"}, {"QUASILUX_FAIL_AT", "-1"}});
    EXPECT_EQ(all.exitCode, 1);
    for (const std::string& file : files) EXPECT_THAT(all.errors, testing::HasSubstr("cannot write " + file));
}

// A render that goes on reads its checkpoint.
TEST_F(FaultsTest, NoneSpoilsAResumedRender) {
    Arguments first = render(2, "a.exr");
    first.insert(first.end(), {"--checkpoint", "begun.ckpt"});
    ASSERT_EQ(run(first).exitCode, 0);
    fs::rename(folder / "begun.ckpt", root / "begun.ckpt");
    clean();
    Arguments resumed = allOutputs();
    resumed.insert(resumed.end(), {"--resume", "../begun.ckpt"});
    const auto counts = countCalls(resumed);
    clean();
    leftWithout_ = objectsLeft(counts);
    for (const char* call : {"read", "fopen", "new", "clEnqueueWriteBuffer"})
        for (const unsigned at : chosen(counts.at(call))) expectGoodEnd(call, at, resumed);
}

/// Renders whose settings are searched, so that the clock says how many passes there are.
class SearchFaults : public FaultsTest {
protected:
    SearchFaults() { EXPECT_TRUE(searches()) << "control"; }

    /// Leaves a checkpoint of a render that had time to search: one that has to compile kernels, or a machine that is
    /// busy, may have none.
    bool searches() const {
        for (unsigned tries = 0; tries < 5; ++tries) {
            clean();
            const Outcome outcome = run(searched);
            EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
            if (hasSearched()) return true;
        }
        return false;
    }
    bool hasSearched() const { return checkpoint().search.passes > 0; }

    Checkpoint checkpoint() const { return checkpointOf(CheckpointReader((folder / "a.ckpt").string())); }

    Outcome runFailingAt(const Arguments& arguments, const std::string& call, unsigned at) const {
        return runFailing(arguments, {{"QUASILUX_FAIL_CALL", call}, {"QUASILUX_FAIL_AT", std::to_string(at)}});
    }

    void expectNothingTemporary() const {
        for (const std::string& name : filesInFolder()) EXPECT_FALSE(name.ends_with(".tmp")) << name;
    }

    const Arguments searched{"render", "scene.xml", "--auto",       "--time", "2",       "--json",
                             "-o",     "a.exr",     "--checkpoint", "a.ckpt", "--every", "0"};
};

// The first one, which is written when the settings are chosen; those after it are.
TEST_F(SearchFaults, FirstCheckpointThatFailsIsFollowedByAWholeOne) {
    const auto writes = static_cast<unsigned>(CheckpointReader((folder / "a.ckpt").string()).names().size()) + 3;
    const std::vector<std::pair<std::string, unsigned>> faults{{"ftruncate", 1},  {"write", 1}, {"write", writes / 2},
                                                               {"write", writes}, {"fsync", 1}, {"rename", 1}};
    unsigned withSearch = 0;
    for (const auto& [call, at] : faults) {
        SCOPED_TRACE(call + ", call " + std::to_string(at));
        clean();
        const Outcome outcome = runFailingAt(searched, call, at);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        EXPECT_THAT(outcome.errors,
                    testing::HasSubstr("no checkpoint could be written, the render goes on: cannot write a.ckpt"));
        withSearch += hasSearched() ? 1 : 0;
        EXPECT_EQ(run({"merge", "a.ckpt", "-o", "check.exr", "--quiet"}).exitCode, 0);
        EXPECT_EQ(radianceOf("check.exr"), radianceOf("a.exr"));
        expectNothingTemporary();
    }
    EXPECT_GT(withSearch, 0u);
}

// A render that goes on from it writes two: as it begins, and at the end.
TEST_F(SearchFaults, LastCheckpointThatFailsLeavesTheOneBefore) {
    const uint64_t before = checkpoint().counters.passes;
    const std::string good = readText(folder / "a.ckpt");
    const Arguments without{"render", "scene.xml", "--json", "-o", "a.exr", "--passes", std::to_string(before + 2),
                            "--auto", "--resume",  "a.ckpt"};
    Arguments resumed = without;
    resumed.insert(resumed.end(), {"--checkpoint", "a.ckpt"});
    const unsigned ofImage = countCalls(without).at("write");
    const auto counts = countCalls(resumed);
    EXPECT_EQ(checkpoint().counters.passes, before + 2); // control
    const auto whole = radianceOf("a.exr");
    const unsigned writes = counts.at("write") - ofImage;
    const std::vector<std::pair<std::string, unsigned>> faults{
        {"write", writes / 2 + 1}, {"write", writes * 3 / 4}, {"write", writes}, {"fsync", 2}, {"rename", 4}};
    for (const auto& [call, at] : faults) {
        SCOPED_TRACE(call + ", call " + std::to_string(at));
        clean();
        std::ofstream(folder / "a.ckpt", std::ios::binary) << good;
        const Outcome outcome = runFailingAt(resumed, call, at);
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_THAT(outcome.errors, testing::HasSubstr("error: no checkpoint of the last passes could be written"));
        EXPECT_THAT(outcome.errors, testing::HasSubstr("cannot write a.ckpt"));
        EXPECT_EQ(checkpoint().counters.passes, before);
        EXPECT_EQ(radianceOf("a.exr"), whole);
        expectNothingTemporary();
    }
}

TEST_F(SearchFaults, ReadingThatFailsNamesTheFile) {
    fs::remove(folder / "a.exr");
    const std::string good = readText(folder / "a.ckpt");
    const Arguments resumed{"render",   "scene.xml", "--json", "-o",       "a.exr",
                            "--passes", "100000",    "--auto", "--resume", "a.ckpt"};
    Arguments counted = resumed;
    counted[6] = std::to_string(checkpoint().counters.passes);
    const unsigned reads = countCalls(counted).at("read");
    fs::remove(folder / "a.exr");
    unsigned ofCheckpoint = 0, tried = 0;
    for (unsigned at = 1; at <= reads; at += std::max(1u, reads / 12), ++tried) {
        SCOPED_TRACE("read, call " + std::to_string(at));
        const Outcome outcome = runFailingAt(resumed, "read", at);
        EXPECT_EQ(outcome.exitCode, 2);
        EXPECT_TRUE(names("read", outcome.errors)) << outcome.errors;
        ofCheckpoint += outcome.errors.find("checkpoint a.ckpt: ") != std::string::npos ? 1 : 0;
    }
    EXPECT_GT(ofCheckpoint, tried / 2);
    EXPECT_EQ(readText(folder / "a.ckpt"), good);
    EXPECT_EQ(filesInFolder(), (std::vector<std::string>{"a.ckpt", "a.ckpt.previous", "plate.obj", "scene.xml"}));
}

TEST_F(FaultsTest, WhatDoesNotFitIsNotCompiled) {
    Arguments tiny = render(1, "a.exr");
    tiny.insert(tiny.end(), {"--device-memory", "10000"});
    const Outcome outcome = runFailing(tiny, {{"QUASILUX_COUNT_CALLS", countFile.string()}});
    EXPECT_EQ(outcome.exitCode, 2);
    EXPECT_THAT(outcome.errors, testing::HasSubstr("MiB"));
    EXPECT_EQ(readCounts().at("clBuildProgram"), 0u);
    EXPECT_GT(countCalls(render(1, "a.exr")).at("clBuildProgram"), 0u); // control
}

// Objects of OpenCL, and files, that are made and not given back.
TEST_F(FaultsTest, PassesTakeNoMoreObjects) {
    const auto few = countCalls(render(10, "a.exr")), many = countCalls(render(200, "a.exr"));
    EXPECT_GT(many.at("clEnqueueNDRangeKernel"), few.at("clEnqueueNDRangeKernel") + 190); // control
    for (const char* made : {"clCreateBuffer", "clCreateKernel", "clCreateProgramWithSource", "clCreateCommandQueue",
                             "clCreateContext", "open", "fopen"})
        EXPECT_EQ(many.at(made), few.at(made)) << made;
    EXPECT_EQ(objectsLeft(many), objectsLeft(few));
    Counts lost = many;
    --lost["clReleaseKernel"];
    EXPECT_NE(objectsLeft(lost), objectsLeft(few)) << "negative control: a kernel that is not given back";
}

// The program calls nothing of OpenCL that cannot be made to fail.
TEST_F(FaultsTest, AllCallsOfOpenClAreKnown) {
    const std::string list = (root / "imports").string();
    const std::string command = std::string("nm -D --undefined-only '") + QUASILUX_PROGRAM + "' > '" + list + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const auto counts = countCalls(allOutputs());
    const std::string text = readText(list);
    const std::regex function("\\bcl[A-Z]\\w*");
    size_t found = 0;
    for (std::sregex_iterator each(text.begin(), text.end(), function), end; each != end; ++each, ++found)
        EXPECT_TRUE(counts.contains(each->str())) << each->str();
    EXPECT_GT(found, 20u);
}

} // namespace
} // namespace quasilux
