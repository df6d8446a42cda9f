// What fails loses nothing that was finished: passes that fail late, devices that refuse, tables that are too large
// (docs/reference/reliability.md). Calls of OpenCL fail on demand (shims/failing_opencl.cpp).
#include "support/lit_plate.h"
#include "support/program_runner.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"

#include "compare/image_file.h"
#include "device/device.h"
#include "prepare/scene_tables.h"
#include "util/error.h"

#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class FailuresTest : public CommandLineTest {
protected:
    FailuresTest() { std::ofstream(folder / "scene.xml") << test::litPlate(); }

    Outcome runFailing(const std::vector<std::string>& arguments, const Variables& variables) const {
        return runWith(QUASILUX_FAILING_OPENCL, arguments, variables);
    }

    /// A render that a failure ends has written the image of as many whole passes as it says.
    void expectImageOfPasses(const Outcome& outcome) const {
        EXPECT_EQ(outcome.exitCode, 1) << outcome.errors;
        ASSERT_TRUE(fs::exists(folder / "a.exr")) << outcome.errors;
        const auto summary = nlohmann::json::parse(outcome.output);
        EXPECT_NE(summary.at("failure"), nullptr);
        const auto passes = summary.at("passes").get<unsigned>();
        ASSERT_GE(passes, 1u);
        const auto whole =
            run({"render", "scene.xml", "-o", "b.exr", "--passes", std::to_string(passes), "--photons", "256"});
        EXPECT_EQ(whole.exitCode, 0) << whole.errors;
        EXPECT_EQ(radianceOf("a.exr"), radianceOf("b.exr")) << passes;
        EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 3); // nothing half written
    }

    std::vector<float> radianceOf(const std::string& name) const {
        return readRadiance((folder / name).string()).radiance;
    }
};

const std::vector<std::string> endless{"render", "scene.xml", "-o",        "a.exr", "--time",
                                       "60",     "--fixed",   "--photons", "256",   "--json"};

// Control: what stands between the program and OpenCL changes nothing by itself.
TEST_F(FailuresTest, NoneWithoutAnOrder) {
    const auto outcome =
        runFailing({"render", "scene.xml", "-o", "a.exr", "--passes", "3", "--photons", "256", "--json"}, {});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_EQ(nlohmann::json::parse(outcome.output).at("failure"), nullptr);
}

TEST_F(FailuresTest, PhotonsOfALatePassLoseNoPass) {
    const auto outcome = runFailing(endless, {{"QUASILUX_FAIL_CALL", "clEnqueueNDRangeKernel"},
                                              {"QUASILUX_FAIL_KERNEL", "tracePhotons"},
                                              {"QUASILUX_FAIL_AT", "40"}});
    EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: kernel tracePhotons"));
    EXPECT_THAT(outcome.errors, HasSubstr("OpenCL error -5"));
    expectImageOfPasses(outcome);
}

// A part of the pass may be in the film: the image is that of the last time when the film was read.
TEST_F(FailuresTest, CameraPathsOfALatePassLoseTwoPercent) {
    const auto outcome = runFailing(endless, {{"QUASILUX_FAIL_CALL", "clEnqueueNDRangeKernel"},
                                              {"QUASILUX_FAIL_KERNEL", "traceCameraPaths"},
                                              {"QUASILUX_FAIL_AFTER", "4"}});
    EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: kernel traceCameraPaths"));
    expectImageOfPasses(outcome);
}

// Alpha is a layer that the device makes last, of one that has failed before or fails then.
TEST_F(FailuresTest, LayersThatFailLoseNoImage) {
    std::string scene = test::litPlate();
    const std::string film = R"(type="hdrfilm">)";
    ASSERT_NE(scene.find(film), std::string::npos);
    std::ofstream(folder / "scene.xml") << scene.insert(scene.find(film) + film.size(),
                                                        R"(<string name="pixel_format" value="rgba"/>)");
    const auto late =
        runFailing(endless, {{"QUASILUX_FAIL_CALL", "clEnqueueNDRangeKernel"}, {"QUASILUX_FAIL_AFTER", "4"}});
    EXPECT_THAT(late.errors, HasSubstr("OpenCL error -5"));
    EXPECT_THAT(late.errors, HasSubstr("the layers of what is met first are left out"));
    expectImageOfPasses(late);
    std::vector<std::string> few = endless;
    few[5] = "60000";
    few.insert(few.end(), {"--passes", "3"});
    const auto last = runFailing(few, {{"QUASILUX_FAIL_CALL", "clEnqueueNDRangeKernel"},
                                       {"QUASILUX_FAIL_KERNEL", "traceAovs"},
                                       {"QUASILUX_FAIL_AT", "1"}});
    EXPECT_EQ(last.exitCode, 1);
    EXPECT_THAT(last.errors, HasSubstr("error: the layers of what is met first are left out"));
    EXPECT_EQ(nlohmann::json::parse(last.output).at("passes"), 3);
    EXPECT_NE(radianceOf("a.exr"), radianceOf("b.exr")); // of other passes
}

TEST_F(FailuresTest, TimesThatCannotBeAskedAreDeviceErrors) {
    const auto outcome =
        runFailing(endless, {{"QUASILUX_FAIL_CALL", "clGetEventProfilingInfo"}, {"QUASILUX_FAIL_AFTER", "4"}});
    EXPECT_THAT(outcome.errors, HasSubstr("(OpenCL error -7)"));
    expectImageOfPasses(outcome);
}

TEST_F(FailuresTest, FirstPassThatFailsLeavesNothing) {
    const auto outcome = runFailing(endless, {{"QUASILUX_FAIL_CALL", "clEnqueueNDRangeKernel"},
                                              {"QUASILUX_FAIL_KERNEL", "traceCameraPaths"},
                                              {"QUASILUX_FAIL_AT", "2"}}); // the first one compiles
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: kernel traceCameraPaths"));
    EXPECT_FALSE(fs::exists(folder / "a.exr"));
}

TEST_F(FailuresTest, DevicesThatCannotBeAskedAreNamed) {
    for (const auto& arguments : {std::vector<std::string>{"devices"}, endless}) {
        const auto outcome =
            runFailing(arguments, {{"QUASILUX_FAIL_CALL", "clGetDeviceInfo"}, {"QUASILUX_FAIL_AT", "1"}});
        EXPECT_EQ(outcome.exitCode, 1);
        EXPECT_THAT(outcome.errors, HasSubstr("quasilux: error: an OpenCL device could not be queried: "));
        EXPECT_THAT(outcome.errors, HasSubstr("OpenCL error -6"));
    }
}

// Several renderers share a device; the report of each has its own buffers.
TEST(BufferBytes, AreThoseOfTheRendererItself) {
    Device device(0);
    const Scene scene = projectScene("furnace_split.xml", {{"resolution", "12"}});
    RenderSettings settings;
    settings.photonsPerPass = 2000;
    Renderer first(device, scene, settings);
    first.renderPass(0);
    const auto alone = first.report().bufferBytes;
    settings.photonsPerPass = 20000;
    Renderer second(device, scene, settings);
    second.renderPass(0);
    EXPECT_EQ(first.report().bufferBytes, alone);
    EXPECT_GT(second.report().bufferBytes.at("photons"), alone.at("photons")); // control
}

TEST(SceneTables, ThatAreTooLargeAreRefused) {
    const std::vector<shared::Packed3> three(3);
    SceneTableWriter tables({1, 2}, 2 + 9 + 1);
    EXPECT_EQ(tables.append(three), 2u);
    EXPECT_EQ(tables.append(std::vector<uint32_t>{5}), 11u); // the last word
    EXPECT_THROW(tables.append(std::vector<uint32_t>{6}), InputError);
    EXPECT_THROW(tables.append(three), InputError);
    EXPECT_EQ(tables.words().size(), 12u);
    EXPECT_EQ(tables.append(std::vector<uint32_t>{}), 12u);
    static_assert(SceneTableWriter::mostWords <= UINT32_MAX);
}

} // namespace
} // namespace quasilux
