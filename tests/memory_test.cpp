// Memory is forecast before it is taken, of the device and of the process, and a render that does not fit does not
// start.
#include "support/lit_plate.h"
#include "support/program_runner.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using testing::HasSubstr;
using testing::Not;
using Arguments = std::vector<std::string>;

/// Share by which a forecast may miss.
constexpr double tolerance = 0.1;

struct Case {
    std::string name;
    Arguments arguments; ///< the scene, and options
};

std::string scene(const char* name) { return std::string(QUASILUX_SOURCE_DIR "/scenes/") + name; }

/// Film, photons and what the process is without them each dominate in one of them.
std::vector<Case> cases() {
    return {{"film", {scene("cornell_phong.xml"), "-D", "resolution=640", "--photons", "50000"}},
            {"photons", {scene("cornell_phong.xml"), "-D", "resolution=64", "--photons", "2000000"}},
            {"media", {scene("fog_caustic.xml")}},
            {"no photons", {scene("furnace_split.xml"), "--quasi-specular", "all", "--variant", "alternative"}},
            {"camera map", {scene("cornell_phong.xml"), "--map", "camera", "-D", "resolution=384"}}};
}

struct Bytes {
    double device = 0, host = 0;
};

// Without learning, whose buffers are freed before the first pass and are not in the forecast (docs/method/memory.md).
class MemoryTest : public CommandLineTest {
protected:
    Outcome run(Arguments arguments) const {
        arguments.insert(arguments.end(), {"--emission", "plain"});
        return CommandLineTest::run(arguments);
    }

    nlohmann::json runJson(Arguments arguments, const std::string& command) const {
        arguments.insert(arguments.begin(), command);
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return nlohmann::json::parse(outcome.output, nullptr, false);
    }

    Bytes forecast(Arguments arguments) const {
        arguments.insert(arguments.end(), {"--json", "--quiet"});
        const auto report = runJson(arguments, "info").at("sceneReport").at("forecast");
        return {report.at("deviceBytes"), report.at("hostPeakBytes")};
    }

    void render(Arguments arguments) const {
        arguments.insert(arguments.end(), {"--json", "--quiet", "--passes", "3", "--stats", "stats.json"});
        runJson(arguments, "render");
    }

    /// Has the kernels of a render and its statistics compiled: those of all its passes, for some are first launched
    /// after the first.
    void compile(const Arguments& arguments) const { render(arguments); }

    Bytes taken(const Arguments& arguments) const {
        render(arguments);
        const auto statistics = nlohmann::json::parse(readText(folder / "stats.json"), nullptr, false);
        double buffers = 0;
        for (const auto& [label, bytes] : statistics.at("sceneReport").at("bufferBytes").items())
            buffers += bytes.get<double>();
        EXPECT_EQ(buffers, statistics.at("peakBufferBytes").get<double>());
        EXPECT_EQ(buffers, statistics.at("sceneReport").at("forecast").at("deviceBytes").get<double>());
        return {buffers, statistics.at("peakHostBytes")};
    }
};

bool isClose(double expected, double taken) { return std::abs(expected - taken) <= tolerance * taken; }

TEST_F(MemoryTest, IsToldBeforeItIsTaken) {
    for (const auto& [name, arguments] : cases()) {
        SCOPED_TRACE(name);
        compile(arguments); // kernels come from the runtime's cache from now on: compiling them takes memory, too
        const Bytes expected = forecast(arguments), real = taken(arguments);
        EXPECT_TRUE(isClose(expected.device, real.device)) << expected.device << " forecast, taken " << real.device;
        EXPECT_TRUE(isClose(expected.host, real.host)) << expected.host << " forecast, taken " << real.host;
    }
}

// Layers of what is met first come when the passes' buffers are gone; here they are more than these.
TEST_F(MemoryTest, OfLayersIsTold) {
    const std::string quantities[] = {"albedo", "depth",  "position", "geo_normal", "sh_normal", "uv",    "dp_du",
                                      "dp_dv",  "duv_dx", "duv_dy",   "albedo",     "position",  "dp_du", "sh_normal"};
    std::string layers;
    for (size_t k = 0; k < 2 * std::size(quantities); ++k)
        layers += fmt::format("{}a{}:{}", k ? "," : "", k, quantities[k % std::size(quantities)]);
    std::string text = test::litPlate(900);
    const std::string film = "<film type=\"hdrfilm\">";
    std::ofstream(folder / "plain.xml") << text;
    text.insert(text.find(film) + film.size(), R"(<string name="pixel_format" value="rgba"/>)");
    text.insert(text.find("<sensor"), R"(<integrator type="aov"><string name="aovs" value=")" + layers +
                                          R"("/><integrator type="path"/></integrator>)");
    std::ofstream(folder / "layers.xml") << text;
    const Arguments options{"--without", "components,bias", "--photons", "50000"};
    const auto of = [&](const std::string& file) {
        Arguments arguments = options;
        arguments.insert(arguments.begin(), file);
        return arguments;
    };
    compile(of("layers.xml")); // kernels come from the cache from now on
    const Bytes real = taken(of("layers.xml"));
    const double expected = forecast(of("layers.xml")).host;
    EXPECT_TRUE(isClose(expected, real.host)) << expected << " forecast, taken " << real.host;
    const double plain = forecast(of("plain.xml")).host;
    EXPECT_FALSE(isClose(plain, real.host)) << "negative control: " << plain << " without layers";
}

// Negative control: the forecast of a film, or of photons, that differ by a fifth is distinguished from the right one.
TEST_F(MemoryTest, OfAnotherRenderDiffers) {
    const Bytes film = taken(cases()[0].arguments), photons = taken(cases()[1].arguments);
    const Bytes smaller = forecast({scene("cornell_phong.xml"), "-D", "resolution=540", "--photons", "50000"});
    const Bytes fewer = forecast({scene("cornell_phong.xml"), "-D", "resolution=64", "--photons", "1500000"});
    EXPECT_FALSE(isClose(smaller.device, film.device));
    EXPECT_FALSE(isClose(smaller.host, film.host));
    EXPECT_FALSE(isClose(fewer.device, photons.device));
}

// Photons that weight windows split are forecast from fewer paths, each of which carries more. A forecast that took
// these for bright photons made room for 19 times as many here.
TEST_F(MemoryTest, RoomForSplitPhotonsIsNearTheirNumber) {
    const Outcome outcome = CommandLineTest::run({"render", scene("real/daylight.xml"), "--quiet", "--passes", "2",
                                                  "--photons", "400000", "--stats", "stats.json"}); // learned
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const auto statistics = nlohmann::json::parse(readText(folder / "stats.json"), nullptr, false);
    const double stored = statistics.at("counters").at("storedBytes"); // of one pass
    const double room = statistics.at("sceneReport").at("bufferBytes").at("photons");
    EXPECT_GE(room, stored);
    EXPECT_LT(room, 2 * stored);
}

// A render that just fits runs; with less its photons come in parts; where these do not fit either it ends before it
// starts, and says what it lacks.
TEST_F(MemoryTest, RenderThatDoesNotFitDoesNotStart) {
    const Arguments arguments{scene("cornell_phong.xml"), "-D", "resolution=128"};
    const auto within = [&](uint64_t bytes, const Arguments& more = {}) {
        Arguments all{"render"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        all.insert(all.end(), {"--passes", "1", "-o", "limited.exr", "--device-memory", std::to_string(bytes)});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const auto needed = static_cast<uint64_t>(forecast(arguments).device);
    const auto partsWithin = [&](uint64_t bytes) {
        const Outcome outcome = run(within(bytes, {"--quiet", "--stats", "stats.json"}));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        const auto statistics = nlohmann::json::parse(readText(folder / "stats.json"), nullptr, false);
        EXPECT_LE(statistics.at("peakBufferBytes").get<uint64_t>(), bytes);
        return statistics.at("sceneReport").at("photonParts").get<unsigned>();
    };
    EXPECT_EQ(partsWithin(needed), 1u);
    EXPECT_EQ(partsWithin(needed - 1), 2u);
    std::filesystem::remove(folder / "limited.exr");

    Arguments ofFewest = arguments; // a pass in as many parts as there may be
    ofFewest.insert(ofFewest.end(), {"--photons", std::to_string(1'000'000 / 64)});
    const auto least = static_cast<uint64_t>(forecast(ofFewest).device) - 20'000;
    const Arguments tight = within(least, {"--photons", "1000000"});
    expectRefused(tight, "0.0 MiB too little");
    const std::string advice = expectRefused(tight, "--photons (now 1000000; more passes make up for them)");
    EXPECT_THAT(advice, HasSubstr("or --map camera"));
    const unsigned photons = std::stoul(advice.substr(advice.find("at most ") + 8));
    const auto withPhotons = [&](unsigned number) { return within(least, {"--photons", std::to_string(number)}); };
    EXPECT_EQ(run(withPhotons(photons)).exitCode, 0) << advice; // as many as it says fit; a tenth more do not
    std::filesystem::remove(folder / "limited.exr");
    expectRefused(withPhotons(photons * 11 / 10), "too little");
    // Less than the scene alone: nothing is compiled for it, and photons do not matter.
    EXPECT_THAT(expectRefused(within(1000), "in one buffer"), Not(HasSubstr("--photons")));
    expectRefused(within(1u << 20, {"--map", "camera"}), "too little");
}

} // namespace
} // namespace quasilux
