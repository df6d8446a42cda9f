// `quasilux bench`: what it makes of errors over time, its plots, and the command from outside.
#include "bench/bench_run.h"
#include "bench/svg_plot.h"
#include "support/program_runner.h"
#include "util/error.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// relMSE = factor * seconds^slope, a pass every tenth of a second, passes 4, 8, …, 4 * 2^(count - 1).
BenchRun powerLaw(double factor, double slope, unsigned count = 8) {
    BenchRun run;
    for (unsigned k = 0; k < count; ++k) {
        BenchPoint point;
        point.passes = 4u << k;
        point.seconds = 0.1 * point.passes;
        point.relMse = factor * std::pow(point.seconds, slope);
        run.points.push_back(point);
    }
    return run;
}

TEST(Convergence, SlopeIsThatOfThePowerLaw) {
    for (const double slope : {-1.0, -0.8, -2.0})
        EXPECT_NEAR(convergenceSlope(powerLaw(0.3, slope)).value(), slope, 1e-9);
    BenchRun bent = powerLaw(0.3, -1); // before pass 16 anything may happen
    bent.points[0].relMse = 100;
    EXPECT_NEAR(convergenceSlope(bent).value(), -1, 1e-9);
    bent.points[5].relMse = 10 * *bent.points[5].relMse;
    EXPECT_GT(std::abs(convergenceSlope(bent).value() + 1), 0.05) << "control: a point off the line shows";
    EXPECT_FALSE(convergenceSlope(powerLaw(0.3, -1, 4))) << "two points from pass 16 on";
}

TEST(Convergence, TimeToAnErrorLiesBetweenItsPoints) {
    const BenchRun run = powerLaw(1e-4, -1); // from 0.4 s: relMSE 2.5e-4, to 51.2 s: 1.95e-6
    const auto within = timeToError(run, 0.01).value();
    EXPECT_NEAR(within.seconds, 1, 1e-9);
    EXPECT_FALSE(within.extrapolated);
    const auto beyond = timeToError(run, 0.0005).value();
    EXPECT_NEAR(beyond.seconds, 400, 1e-6);
    EXPECT_TRUE(beyond.extrapolated);
    EXPECT_EQ(timeToError(run, 0.5).value().seconds, run.points[0].seconds) << "reached by the first point";
    BenchRun unknown = powerLaw(1e-4, -1);
    for (auto& point : unknown.points) point.relMse = -1e-9; // below the reference's noise
    EXPECT_NO_THROW(timeToError(unknown, 0.01));
    EXPECT_FALSE(timeToError(unknown, 0.01));
}

TEST(BenchMethods, OverrideWhatTheSceneSays) {
    RenderSettings settings;
    parseBenchMethod("standard:2:photons").apply(settings);
    EXPECT_EQ(settings.quasiSpecular, "none");
    EXPECT_TRUE(settings.quasiSpecularOverridesScene);
    EXPECT_EQ(settings.bdd, 2u);
    EXPECT_EQ(settings.direct, DirectLight::photons);
    settings = {};
    parseBenchMethod("alternative:1:camera:generic:level=0.1").apply(settings);
    EXPECT_EQ(settings.variant, Variant::alternative);
    EXPECT_EQ(settings.map, MapOrder::camera);
    EXPECT_TRUE(settings.genericKernels);
    EXPECT_EQ(settings.quasiSpecular, "level:0.1");
    for (const char* wrong : {"", "mian", "main:x", "main:1x", "main:level="})
        EXPECT_THROW(parseBenchMethod(wrong), InputError) << wrong;
}

TEST(Plot, PutsDecadesAtEqualDistances) {
    const std::string svg = logLogPlot({"a < b", "s", "e"}, {{"one", {{1, 1e-2}, {10, 1e-3}, {100, 1e-4}, {0, 1}}}});
    EXPECT_THAT(svg, HasSubstr("a &lt; b"));
    EXPECT_THAT(svg, HasSubstr("M70.0,34.0 L260.0,202.0 L450.0,370.0 \""))
        << "the point without a logarithm is left out";
    EXPECT_THAT(logLogPlot({"empty", "", ""}, {{"none", {{1, -1}}}}), HasSubstr("nothing to draw"));
}

class BenchCommand : public CommandLineTest {
protected:
    const std::string box = std::string(QUASILUX_SOURCE_DIR) + "/scenes/cornell_phong.xml";

    std::vector<std::string> with(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"bench", "scene.xml", "--time", "0.3"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
};

TEST_F(BenchCommand, ReportsEveryMethod) {
    ASSERT_EQ(
        run({"render", box, "-D", "resolution=8", "--passes", "64", "--seed", "9", "-o", "reference.exr"}).exitCode, 0);
    const Outcome outcome = run({"bench", box, "-D", "resolution=8", "--time", "0.3", "--method", "scene", "--method",
                                 "standard:1", "--reference", "reference.exr", "--reference-noise", "1e-6", "--json",
                                 "-o", "bench.json", "--html", "bench.html"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const json report = json::parse(outcome.output, nullptr, false);
    ASSERT_EQ(report.at("runs").size(), 2u);
    for (const json& one : report["runs"]) {
        const json& last = one.at("points").back();
        EXPECT_GE(last.at("seconds"), 0.3);
        EXPECT_GT(last.at("cpuSeconds"), 0);
        EXPECT_TRUE(last.at("relMse").is_number());
        EXPECT_GT(last.at("passes"), 0);
        EXPECT_EQ(one.at("counters").at("passes"), last.at("passes"));
        EXPECT_FALSE(one.at("kernelSeconds").empty());
    }
    EXPECT_EQ(report["runs"][1]["settings"]["quasiSpecular"], "none");
    EXPECT_EQ(report["runs"][1]["settings"]["bdd"], 1);
    EXPECT_EQ(json::parse(readText(folder / "bench.json")), report);
    const std::string page = readText(folder / "bench.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("error against the reference"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(page, Not(HasSubstr("http"))) << "the page needs nothing besides itself";
}

TEST_F(BenchCommand, ScenesOfOneNameStayApart) {
    std::filesystem::create_directory(folder / "other");
    std::filesystem::copy_file(folder / "scene.xml", folder / "other/scene.xml");
    const Outcome outcome =
        run({"bench", "scene.xml", "other/scene.xml", "--time", "0.05", "--method", "scene", "--json"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const json report = json::parse(outcome.output, nullptr, false);
    ASSERT_EQ(report.at("runs").size(), 2u);
    EXPECT_EQ(report["runs"][0]["scene"], "scene.xml");
    EXPECT_EQ(report["runs"][1]["scene"], "other/scene.xml");
}

TEST_F(BenchCommand, ARunThatFailsLeavesTheOthers) {
    std::string huge = readText(folder / "scene.xml");
    for (const std::string side : {"width", "height"}) { // more pixels than any device has memory for
        const std::string small = "name=\"" + side + "\" value=\"4\"";
        ASSERT_THAT(huge, HasSubstr(small));
        huge.replace(huge.find(small), small.size(), "name=\"" + side + "\" value=\"32768\"");
    }
    std::ofstream(folder / "huge.xml") << huge;
    const Outcome outcome = run({"bench", "huge.xml", "scene.xml", "--time", "0.05", "--method", "scene", "--json"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.errors, HasSubstr("error: huge.xml, scene, device 0: "));
    const json report = json::parse(outcome.output, nullptr, false);
    ASSERT_EQ(report.at("runs").size(), 1u);
    EXPECT_EQ(report["runs"][0]["scene"], "scene.xml");
    ASSERT_EQ(report.at("failures").size(), 1u);
    EXPECT_EQ(report["failures"][0]["what"], "huge.xml, scene, device 0");
    expectRefused({"bench", "huge.xml", "--time", "0.05", "--method", "scene"}, "memory");
}

TEST_F(BenchCommand, BadInputIsRefused) {
    expectRefused(with({"--method", "mian"}), "--method mian: 'mian' is not known");
    expectRefused(with({"--reference", "nowhere.exr"}), "nowhere.exr");
    expectRefused(with({"--reference", "-", "--reference", "-"}), "--reference is given 2 times for 1 scenes");
    expectRefused(with({"--reference-noise", "1"}), "--reference-noise is given 1 times for 0 references");
    expectRefused(with({"--html", "page.txt"}), "--html");
    expectRefused({"bench", "nowhere.xml"}, "nowhere.xml");
    ASSERT_EQ(run({"render", box, "-D", "resolution=8", "--passes", "1", "-o", "reference.exr"}).exitCode, 0);
    expectRefused(with({"--reference", "reference.exr"}), "reference.exr is 8 x 8, the film of scene.xml 4 x 4");
}

} // namespace
} // namespace quasilux
