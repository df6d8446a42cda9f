// The parts of `quasilux bench` besides error over time: what they make of costs, and the command from outside.
// No time is judged.
#include "bench/device_energy.h"
#include "bench/parts/device_comparison.h"
#include "bench/parts/growth.h"
#include "bench/parts/growth_scene.h"
#include "bench/parts/paired_ratio.h"
#include "bench/power_law.h"
#include "support/program_runner.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(PowerLaw, ExponentAndItsErrorAreThoseOfTheLine) {
    const auto exact = fitPowerLaw({{1, 3}, {10, 3 * std::pow(10, 0.7)}, {1000, 3 * std::pow(1000, 0.7)}});
    ASSERT_TRUE(exact);
    EXPECT_NEAR(exact->exponent, 0.7, 1e-12);
    EXPECT_NEAR(exact->standardError, 0, 1e-7);
    // Logarithms 0, 1, 2 against 0, 1, 0: slope 0, residual squares 2/3, so the error is sqrt(2/3 / 1 / 2).
    const double e = std::exp(1.0);
    const auto bent = fitPowerLaw({{1, 1}, {e, e}, {e * e, 1}});
    ASSERT_TRUE(bent);
    EXPECT_NEAR(bent->exponent, 0, 1e-12);
    EXPECT_NEAR(bent->standardError, std::sqrt(1.0 / 3), 1e-12);
    EXPECT_FALSE(fitPowerLaw({{1, 1}, {2, 2}, {3, 0}})) << "a cost of 0 has no logarithm";
    EXPECT_FALSE(fitPowerLaw({{2, 1}, {2, 2}, {2, 3}})) << "a single size";
}

TEST(PairedRatio, IsTheMedianAndIgnoresOneDisturbedPair) {
    const PairedRatio calm = medianRatio({1.9, 2.0, 2.1, 2.0, 2.0}), disturbed = medianRatio({1.9, 2.0, 2.1, 2.0, 50});
    EXPECT_EQ(calm.ratio, 2.0);
    EXPECT_EQ(disturbed.ratio, 2.0);
    // Quartiles 1, 2 of 0.5, 1, 1.5, 2, 2.5.
    EXPECT_NEAR(medianRatio({2.5, 0.5, 1.5, 1, 2}).standardError, 1.2533 / 1.349 / std::sqrt(5.0), 1e-12);
    EXPECT_EQ(medianRatio({3}).ratio, 3);
    EXPECT_EQ(medianRatio({3}).standardError, 0);
}

TEST(GrowthScene, HasAboutTheTrianglesAskedForAllFacingOutwards) {
    for (const unsigned wanted : {100u, 2700u, 73'000u}) {
        const Scene scene = growthScene(wanted, 16);
        const Mesh& sphere = scene.shapes.back().mesh;
        EXPECT_NEAR(double(sphere.triangles.size()), wanted, 0.25 * wanted);
        EXPECT_FALSE(sphere.cornerNormals.empty());
        size_t inwards = 0;
        for (const glm::uvec3& t : sphere.triangles) {
            const glm::vec3 a = sphere.positions[t.x], b = sphere.positions[t.y], c = sphere.positions[t.z];
            inwards += glm::dot(glm::cross(b - a, c - a), a + b + c) <= 0;
        }
        EXPECT_EQ(inwards, 0u) << wanted;
    }
    EXPECT_EQ(growthScene(100, 16).sensor.width, 16u);
}

TEST(Growth, ReportsWhereASeriesStopped) {
    GrowthSeries series;
    series.subject = "photons";
    for (const double size : {1.0, 10.0, 100.0}) {
        PassMeasurement measured;
        measured.least.cpu = measured.least.clock = 0.1 * size;
        measured.least.kernelCosts = {{"tracePhotons", 0.05 * size * size}, {"tiny", 1e-9}};
        measured.bufferBytes = 1000;
        series.points.push_back({size, measured});
    }
    series.stopped = "1000: no memory";
    const BenchSection section = growthSection({series});
    const json& figures = section.figures.at(0);
    EXPECT_NEAR(figures.at("exponents").at("pass").at("exponent").get<double>(), 1, 1e-9);
    EXPECT_NEAR(figures.at("exponents").at("tracePhotons").at("exponent").get<double>(), 2, 1e-9);
    EXPECT_FALSE(figures.at("exponents").contains("tiny")) << "a kernel that takes next to nothing";
    EXPECT_FALSE(figures.at("exponents").contains("preparing")) << "measured by triangles only";
    EXPECT_EQ(figures.at("stopped"), series.stopped);
    EXPECT_THAT(section.tables.at(0).note, HasSubstr("Stopped at 1000: no memory"));
    EXPECT_THAT(section.tables.at(0).plot, HasSubstr("<svg"));
}

class Powercap : public testing::Test {
protected:
    void write(const std::string& zone, uint64_t microjoules) {
        std::filesystem::create_directories(folder / zone);
        std::ofstream(folder / zone / "energy_uj") << microjoules << '\n';
        std::ofstream(folder / zone / "max_energy_range_uj") << 5'000'000 << '\n';
    }

    TemporaryFolder temporary;
    std::filesystem::path folder = temporary.path() / "powercap";
    DeviceInfo cpu = [] {
        DeviceInfo info;
        info.isCpu = true;
        return info;
    }();
};

TEST_F(Powercap, PackagesAddUpAndCountersBeginAnew) {
    write("intel-rapl:0", 1'000'000);
    write("intel-rapl:0:0", 400'000); // a part of the package
    write("intel-rapl:1", 4'900'000);
    EnergyCounter counter(cpu, folder);
    const double before = counter.joules().value();
    write("intel-rapl:0", 1'500'000);
    write("intel-rapl:0:0", 900'000);
    write("intel-rapl:1", 200'000); // 5'000'000 is the last value before 0
    EXPECT_NEAR(counter.joules().value() - before, 0.5 + 0.3, 1e-12);
}

TEST_F(Powercap, NothingIsReportedWithoutCounters) {
    EXPECT_FALSE(EnergyCounter(cpu, folder).joules()) << "no folder";
    write("intel-rapl:0", 1);
    EXPECT_TRUE(EnergyCounter(cpu, folder).joules());
    EXPECT_FALSE(EnergyCounter(DeviceInfo{}, folder).joules()) << "another device is not the CPU";
}

TEST(DeviceTolerance, RefusesAnotherMeanAndOtherPaths) {
    EXPECT_TRUE((SamePassDifference{0, 0, 0}.isWithin()));
    EXPECT_TRUE((SamePassDifference{-5e-4, 0.01, 0.1}.isWithin()));
    EXPECT_FALSE((SamePassDifference{-2e-3, 0.01, 0.1}.isWithin()));
    EXPECT_FALSE((SamePassDifference{0, 0.1, 1.4}.isWithin())) << "independent images: the root of 2";
}

class BenchParts : public CommandLineTest {
protected:
    json report(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return json::parse(outcome.output, nullptr, false);
    }
};

TEST_F(BenchParts, GrowthNeedsNoScene) {
    const json found = report(
        {"bench", "--growth", "bdd,pixels", "--growth-steps", "3", "--time", "0.01", "--json", "--html", "page.html"});
    EXPECT_TRUE(found.at("runs").empty());
    ASSERT_EQ(found.at("growth").size(), 2u);
    for (const json& series : found["growth"]) {
        ASSERT_EQ(series.at("points").size(), 3u);
        EXPECT_TRUE(series.at("exponents").at("pass").at("standardError").is_number());
        EXPECT_TRUE(series.at("stopped").is_null());
        for (const json& point : series["points"]) {
            EXPECT_GT(point.at("kernels").at("tracePhotons"), 0);
            EXPECT_GT(point.at("triangles"), 9000);
        }
    }
    const std::string page = readText(folder / "page.html");
    EXPECT_THAT(page, HasSubstr("cost of a pass by pixels"));
    EXPECT_THAT(page, HasSubstr("1 + BDD"));
}

TEST_F(BenchParts, ThreadsDevicesAndKernelsOfAScene) {
    const json found = report({"bench", "scene.xml", "--growth", "threads", "--compare-devices", "--compare-kernels",
                               "--pass-times", "--device", "0", "--device", "0", "--time", "0.05", "--json"});
    ASSERT_EQ(found.at("threads").size(), 2u);
    for (const json& one : found["threads"]) {
        const unsigned units = found.at("devices").at(0).at("computeUnits");
        const json& last = one.at("points").back();
        EXPECT_LE(last.at("threads"), units);
        EXPECT_GT(2 * last.at("threads").get<unsigned>(), units);
        EXPECT_EQ(one["points"][0].at("speedUp").at("pass"), 1.0);
        EXPECT_TRUE(last.at("speedUp").contains("traceCameraPaths"));
    }
    ASSERT_EQ(found.at("deviceComparison").size(), 2u);
    EXPECT_TRUE(found["deviceComparison"][0].at("difference").is_null());
    const json& same = found["deviceComparison"][1].at("difference");
    EXPECT_EQ(same.at("rms"), 0) << "the same device twice";
    EXPECT_EQ(same.at("within"), true);
    ASSERT_EQ(found.at("kernels").size(), 2u);
    for (const json& one : found["kernels"]) {
        EXPECT_GE(one.at("pairs"), 4);
        EXPECT_GT(one.at("genericOverScene").at("pass").at("ratio"), 0);
    }
    EXPECT_EQ(found.at("passTimes").size(), 2u);
}

TEST_F(BenchParts, BadInputIsRefused) {
    expectRefused({"bench"}, "no SCENE is given, expected at least one");
    expectRefused({"bench", "--growth", "threads"}, "no SCENE is given");
    expectRefused({"bench", "--growth", "triangles", "--compare-kernels"}, "no SCENE is given");
    expectRefused({"bench", "--growth", "triangle"}, "unknown value 'triangle'");
    expectRefused({"bench", "--growth", "bdd", "--growth-steps", "0"}, "--growth-steps");
}

} // namespace
} // namespace quasilux
