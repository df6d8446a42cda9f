// The built program from outside: help, the device list, and that bad input ends with code 2 and writes nothing.
// Also the names that options take.
#include "support/program_runner.h"

#include "cli/option_checks.h"
#include "cli/options.h"
#include "util/nearest.h"
#include "util/stopwatch.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <sys/wait.h>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(CommandLineTest, HelpStatesEveryOptionWithUnitAndDefault) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> promised{
        {"render",
         {"-o",      "--png",          "--time",     "--passes",         "--checkpoint",      "--every", "--resume",
          "--error", "--bdd",          "--variant",  "--quasi-specular", "--direct",          "--map",   "--photons",
          "--seed",  "--radius-scale", "--kernels",  "--device",         "--work-group-size", "-D",      "--stats",
          "--json",  "--quiet",        "--exposure", "--exposure-scale"}},
        {"compare",
         {"--mask", "--region", "--html", "--reference-stderr", "--max-relmse", "--max-bias", "--max-nonfinite",
          "--json"}},
        {"merge", {"-o", "--png", "--checkpoint", "--json", "--quiet"}},
        {"view", {"--listen", "--port", "--no-browser", "--time", "--bdd", "--device", "-D"}},
        {"devices", {"--json"}},
        {"info", {"--json", "--bdd", "--device", "-D"}}};
    const std::string documentation = readText(QUASILUX_SOURCE_DIR "/docs/reference/command-line.md");
    Options options;
    CLI::App app;
    declareOptions(app, options);
    for (const auto& [command, names] : promised) {
        const Outcome outcome = run({command, "--help"});
        EXPECT_EQ(outcome.exitCode, 0);
        EXPECT_EQ(outcome.errors, "");
        for (const auto& name : names)
            EXPECT_NE(app.get_subcommand(command)->get_option_no_throw(name), nullptr) << name;
        for (const auto* option : app.get_subcommand(command)->get_options()) {
            if (option->get_positional() || option->check_name("--help")) continue;
            SCOPED_TRACE(option->get_name());
            EXPECT_THAT(outcome.output, HasSubstr(option->get_name(false, true)));
            EXPECT_THAT(outcome.output, HasSubstr(option->get_description()));
            EXPECT_THAT(option->get_description(), HasSubstr("(default: "));
            const bool isFlag = option->get_items_expected_max() == 0;
            EXPECT_TRUE(isFlag || !option->get_type_name().empty()) << "no unit or kind of value";
            for (const auto& name : option->get_lnames()) EXPECT_THAT(documentation, HasSubstr("`--" + name));
        }
    }
}

TEST_F(CommandLineTest, TopLevelHelpAndVersion) {
    const Outcome help = run({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    for (const char* command : {"render", "compare", "devices", "info"}) EXPECT_THAT(help.output, HasSubstr(command));
    const Outcome version = run({"--version"});
    EXPECT_EQ(version.exitCode, 0);
    EXPECT_EQ(version.output, "quasilux " QUASILUX_VERSION "\n");
}

// CLI11 takes 010 for octal, and 08 for no number.
TEST(WholeNumbers, AreDecimalAlsoWithLeadingZeros) {
    const auto parsed = [](const std::string& text, bool checks) {
        CLI::App app;
        uint64_t value = 0;
        CLI::Option* option = app.add_option("-n", value);
        if (checks) option->transform(wholeNumber(0, 100));
        app.parse("-n " + text);
        return value;
    };
    EXPECT_EQ(parsed("010", true), 10u);
    EXPECT_EQ(parsed("08", true), 8u);
    EXPECT_THROW(parsed("0101", true), CLI::ValidationError);
    EXPECT_EQ(parsed("010", false), 8u) << "control: what it does by itself";
}

TEST_F(CommandLineTest, DevicesAreListedAsTableAndJson) {
    const Outcome json = run({"devices", "--json"});
    EXPECT_EQ(json.exitCode, 0);
    const auto rows = nlohmann::json::parse(json.output);
    ASSERT_GE(rows.size(), 1u);
    EXPECT_EQ(rows[0]["number"], 0);
    EXPECT_GT(rows[0]["globalMemory"], 0);
    EXPECT_GT(rows[0]["computeUnits"], 0);

    const Outcome table = run({"devices"});
    EXPECT_EQ(table.exitCode, 0);
    EXPECT_EQ(std::count(table.output.begin(), table.output.end(), '\n'), static_cast<long>(rows.size()) + 1);
    for (const auto& row : rows) EXPECT_THAT(table.output, HasSubstr(row["name"].get<std::string>()));
}

TEST_F(CommandLineTest, UnknownCommandsAndArgumentsAreRefused) {
    expectRefused({}, "no command given, expected render, view, merge, compare, photometry, falsecolour, report, dgp, "
                      "bench, devices, doctor, manual or info");
    expectRefused({"rendr"}, "unknown argument 'rendr', did you mean 'render'?");
    expectRefused({"render"}, "SCENE is required");
    expectRefused({"render", "scene.xml", "--sed", "4"}, "did you mean '--seed'?");
    expectRefused({"render", "scene.xml", "--seed", "4", "--seed", "5"}, "--seed is given 2 times; give it once");
    expectRefused({"render", "scene.xml", "--passes"}, "--passes");
}

TEST_F(CommandLineTest, ValuesOutOfRangeAreRefused) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> bad{
        {"--bdd", {"-1", "1.5", "1001", "x"}},
        {"--photons", {"0", "-5", "1e6", "99999999999"}},
        {"--passes", {"0", "-1", "two", "3:3", "4:2", "1:", ":5", "1:2:3", "-1:2"}},
        {"--every", {"-1", "nan"}},
        {"--seed", {"-1", "18446744073709551616"}},
        {"--time", {"0", "-3", "nan", "inf", "5s"}},
        {"--error", {"0", "-0.1", "1.5", "nan"}},
        {"--radius-scale", {"0", "-1", "inf"}},
        {"--work-group-size", {"0", "5000"}},
        {"--device", {"-1", "cpu"}}};
    for (const auto& [option, values] : bad)
        for (const auto& value : values)
            expectRefused({"render", "scene.xml", option + "=" + value}, option + ": '" + value + "' given, expected ");
    expectRefused({"render", "scene.xml", "--variant", "mian"}, "expected main or alternative, did you mean 'main'?");
    expectRefused({"render", "scene.xml", "--direct", "x"}, "expected emitters or photons");
    expectRefused({"render", "scene.xml", "--kernels", "x"}, "expected scene or generic");
    expectRefused({"render", "scene.xml", "--without", "bias,noise"}, "expected components or bias");
    expectRefused({"render", "--without", "bias", "missing.xml"},
                  "cannot read the scene file 'missing.xml'"); // no part of the list
    expectRefused({"render", "scene.xml", "--quasi-specular", "a,,b"}, "expected auto, none, all or ids");
    expectRefused({"render", "scene.xml", "--quasi-specular", "none,a"}, "expected auto, none, all or ids");
    expectRefused({"render", "scene.xml", "-D", "width"}, "expected name=value");
    expectRefused({"info", "scene.xml", "--bdd", "-1"}, "expected a whole number from 0");
}

TEST_F(CommandLineTest, ContradictionsAreRefused) {
    expectRefused({"render", "scene.xml", "--exposure", "1"}, "--exposure requires --png");
    expectRefused({"render", "scene.xml", "--png", "a.png", "--exposure", "1", "--exposure-scale", "2"}, "excludes");
    expectRefused({"render", "scene.xml", "--bdd", "1", "--bdd", "2"}, "--bdd");
}

TEST_F(CommandLineTest, OutputsAreCheckedBeforeRendering) {
    // The limit on passes keeps the test short should the check be missing.
    const std::vector<std::string> render{"render", "scene.xml", "--passes", "1"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), render.begin(), render.end());
        return more;
    };
    expectRefused(with({"-o", "gone/a.exr"}), "--output gone/a.exr: folder gone does not exist");
    // Before the scene is even read: of two faults, the folder is the one named.
    expectRefused({"render", "missing.xml", "-o", "gone/a.exr"}, "folder gone does not exist");
    expectRefused(with({"-o", "a.jpg"}), "unknown extension '.jpg'");
    expectRefused(with({"--png", "gone/a.png"}), "--png gone/a.png: folder gone does not exist");
    expectRefused(with({"--png", "a.exr"}), "expected a name that ends in .png");
    expectRefused(with({"--stats", "gone/a.json"}), "--stats gone/a.json: folder gone does not exist");
    expectRefused(with({"--stats", "/proc/a.json"}), "--stats /proc/a.json: cannot write there");
    expectRefused(with({"--stats", "a.txt"}), "expected a name that ends in .json");
}

TEST_F(CommandLineTest, MissingScenesAndDevicesAreRefused) {
    expectRefused({"render", "missing.xml", "--passes", "1"}, "missing.xml");
    expectRefused({"info", "missing.xml"}, "missing.xml");
    expectRefused({"render", "scene.xml", "--passes", "1", "--device", "999"}, "--device 999");
    expectRefused({"info", "scene.xml", "--device", "999"}, "--device 999");
}

TEST_F(CommandLineTest, SensorsAreRenderedByNumberOrAll) {
    std::ofstream(folder / "two.xml")
        << R"(<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm"><integer name="width"
        value="5"/><integer name="height" value="4"/></film></sensor><sensor type="perspective" id="small"><film
        type="hdrfilm"><integer name="width" value="3"/><integer name="height" value="2"/></film></sensor><emitter
        type="constant"/></scene>)";
    const auto written = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"render", "two.xml", "--passes", "1", "--fixed"});
        const Outcome outcome = run(more);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (name == "scene.xml" || name == "two.xml") continue;
            names.push_back(name);
            fs::remove(entry.path());
        }
        return names;
    };
    EXPECT_THAT(written({}), testing::ElementsAre("two.exr"));
    EXPECT_THAT(written({"--sensor", "small", "-o", "a.exr"}), testing::ElementsAre("a.exr"));
    EXPECT_THAT(written({"--sensor", "all", "--png", "p.png"}),
                testing::UnorderedElementsAre("two_0.exr", "two_1.exr", "p_0.png", "p_1.png"));
    expectRefused({"render", "two.xml", "--passes", "1", "--sensor", "2"},
                  "no sensor '2'; its sensors have the numbers 0 to 1");
    expectRefused({"info", "two.xml", "--sensor", "all"}, "no sensor 'all'");
}

/// How far a render gets in 5 s depends on the machine; that it ends soon, by exit, with a whole file or none, does
/// not.
TEST_F(CommandLineTest, CtrlCEndsARenderAndKeepsWhatIsThere) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = run({"render", "scene.xml", "-o", "a.exr", "--time", "500", "--json"}, 5);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(250));
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    if (outcome.exitCode == 0) {
        EXPECT_THAT(names, testing::UnorderedElementsAre("scene.xml", "a.exr"));
        const auto summary = nlohmann::json::parse(outcome.output);
        EXPECT_EQ(summary["interrupted"], true);
        EXPECT_GE(summary["passes"], 1);
    } else {
        EXPECT_EQ(outcome.exitCode, 130) << outcome.errors;
        EXPECT_THAT(names, testing::ElementsAre("scene.xml"));
    }
}

// A scheduler that ends the render learns that it has not got to its end; what there is has been written.
TEST_F(CommandLineTest, OtherSignalsEndItWithTheirCode) {
    for (const int signal : {SIGTERM, SIGHUP}) {
        const fs::path checkpoint = root / (std::to_string(signal) + ".ckpt");
        const auto rendersForASecond = [&, since = std::optional<Stopwatch>()]() mutable {
            if (!since && fs::exists(checkpoint)) since.emplace(); // the first one is written as rendering begins
            return since && since->seconds() > 1;
        };
        const Outcome outcome = runUntil({"render", "scene.xml", "-o", "a.exr", "--time", "500", "--fixed", "--json",
                                          "--checkpoint", checkpoint.string()},
                                         rendersForASecond, signal);
        EXPECT_EQ(outcome.exitCode, 128 + signal) << outcome.errors;
        ASSERT_TRUE(fs::exists(folder / "a.exr")) << outcome.errors;
        EXPECT_EQ(nlohmann::json::parse(outcome.output)["interrupted"], true);
        fs::remove(folder / "a.exr");
        EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
    }
}

// What the map holds is known before a render. With the whole phase function as quasi-specular a camera path stores one
// point in a medium by the main variant, and one at each collision by the alternative one.
TEST_F(CommandLineTest, InfoTellsWhatTheMapHolds) {
    const auto stored = [this](const std::string& variant) {
        const Outcome outcome =
            run({"info", QUASILUX_SOURCE_DIR "/scenes/furnace_medium.xml", "--json", "--map", "camera", "--variant",
                 variant, "--quasi-specular", "all", "-D", "border=glass", "-D", "sigma_t=9,9,9"});
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        const auto pass = nlohmann::json::parse(outcome.output)["trialPass"];
        EXPECT_GT(pass["storedBytes"], pass["storedPoints"]);
        return pass["storedPoints"].get<double>();
    };
    EXPECT_GT(stored("alternative"), 3 * stored("main"));
}

TEST_F(CommandLineTest, InfoHasPowersInTheUnitsOfTheScene) {
    const auto informed = [&](const std::string& instruction) {
        std::ofstream(folder / "units.xml")
            << "<scene version=\"3.0.0\">" << instruction
            << R"(<sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/>
               </film></sensor><emitter type="point"/><shape type="sphere"/></scene>)";
        return run({"info", "units.xml"}).output;
    };
    EXPECT_THAT(informed(""), HasSubstr("power (W)"));
    EXPECT_THAT(informed("<?quasilux units=\"photometric\"?>"), HasSubstr("power (lm)"));
}

TEST(Names, OfComponentsAndSettings) {
    const std::vector<std::string> names{"direct", "caustic", "quasi_caustic", "diffuse", "emission"};
    for (unsigned i = 0; i < FILM_COMPONENTS; ++i) EXPECT_EQ(componentName(i), names[i]);
    EXPECT_THROW(componentName(FILM_COMPONENTS), std::out_of_range);
    for (const auto variant : {Variant::main, Variant::alternative})
        EXPECT_EQ(parseChoice<Variant>(name(variant)), variant);
    for (const auto direct : {DirectLight::emitters, DirectLight::photons})
        EXPECT_EQ(parseChoice<DirectLight>(name(direct)), direct);
    for (const auto map : {MapOrder::photons, MapOrder::camera}) EXPECT_EQ(parseChoice<MapOrder>(name(map)), map);
    EXPECT_THROW(parseChoice<MapOrder>("cameras"), InputError);
    try {
        parseChoice<DirectLight>("photon");
        FAIL() << "an unknown name was taken";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("expected emitters or photons, did you mean 'photons'?"));
    }
}

// Some fifth of the photons contribute to this box's light: 200 are too few for a render to know its noise, 5000 are
// not.
TEST_F(CommandLineTest, RareLightIsWarnedOf) {
    const auto errors = [&](const char* photons, const char* passes) {
        const Outcome outcome = run({"render", QUASILUX_SOURCE_DIR "/scenes/cornell_phong.xml", "--fixed", "--photons",
                                     photons, "--passes", passes, "-D", "resolution=32", "-o", "box.exr"});
        EXPECT_EQ(outcome.exitCode, 0);
        return outcome.errors;
    };
    EXPECT_THAT(errors("200", "1"), HasSubstr("too few to estimate that light or its error; render longer"));
    EXPECT_EQ(errors("5000", "1"), "");
}

// Without light there is no noise to see: 0 % of error is no promise. Control: the lamp before the camera.
TEST_F(CommandLineTest, BlackImagesAreWarnedOf) {
    std::string behind = readText(folder / "scene.xml");
    const std::string before = "<translate z=\"8\"/>";
    std::ofstream(folder / "behind.xml") << behind.replace(behind.find(before), before.size(), "<translate z=\"-8\"/>");
    const auto errors = [&](const char* scene) { return run({"render", scene, "--fixed", "--passes", "2"}).errors; };
    EXPECT_THAT(errors("behind.xml"),
                HasSubstr("none has reached the image in 2 passes, so that its error is not known"));
    EXPECT_EQ(errors("scene.xml"), "");
}

TEST(Names, NearestIsNearOrEmpty) {
    EXPECT_EQ(nearestName("--sed", {"--seed", "--error"}), "--seed");
    EXPECT_EQ(nearestName("Mian", {"main", "alternative"}), "main");
    EXPECT_EQ(nearestName("zzzz", {"main", "alternative"}), "");
}

TEST(Settings, ComeFromTheSceneOverDefaults) {
    Scene scene;
    scene.path = "box.xml";
    EXPECT_EQ(settingsFromScene(scene).bdd, 0u);
    EXPECT_EQ(settingsFromScene(scene).seed, 1u);
    scene.settings.bdd = 2;
    scene.settings.variant = Variant::alternative;
    scene.settings.direct = DirectLight::photons;
    scene.settings.map = MapOrder::camera;
    scene.settings.quasiSpecular = "none";
    scene.settings.photons = 77;
    scene.settings.seed = 5;
    const RenderSettings settings = settingsFromScene(scene);
    EXPECT_EQ(settings.bdd, 2u);
    EXPECT_EQ(settings.variant, Variant::alternative);
    EXPECT_EQ(settings.direct, DirectLight::photons);
    EXPECT_EQ(settings.map, MapOrder::camera);
    EXPECT_EQ(settings.quasiSpecular, "none");
    EXPECT_FALSE(settings.quasiSpecularOverridesScene);
    EXPECT_EQ(settings.photonsPerPass, 77u);
    EXPECT_EQ(settings.seed, 5u);
}

/// `arguments`, with all that the shell makes of them; the exit code.
int runByShell(const fs::path& folder, const std::string& before, const std::string& arguments) {
    const std::string command =
        "cd '" + folder.string() + "' && { " + before + " '" QUASILUX_PROGRAM "' " + arguments + "; }";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr const char* quickRender = "render scene.xml --photons 64 --passes 2 --auto -o a.exr";

// What cannot be said loses no image, and changes no exit code.
TEST_F(CommandLineTest, MessagesThatCannotBeWrittenAreLeftOut) {
    for (const char* nowhere : {" 2>/dev/full", " 2>&-"}) {
        SCOPED_TRACE(nowhere);
        EXPECT_EQ(runByShell(folder, "", "render none.xml" + std::string(nowhere)), 2);
        EXPECT_EQ(runByShell(folder, "", quickRender + std::string(" >/dev/null") + nowhere), 0);
        EXPECT_TRUE(fs::remove(folder / "a.exr"));
    }
    // To a pipe that nobody reads; the summary is lost in it.
    const std::string piped = quickRender + std::string("; echo $? >code; } 2>&1 | { true");
    EXPECT_EQ(runByShell(folder, "", piped), 0);
    EXPECT_EQ(readText(folder / "code"), "1\n");
    EXPECT_TRUE(fs::exists(folder / "a.exr"));
}

TEST_F(CommandLineTest, ResultsThatCannotBeWrittenAreAFailure) {
    for (const char* nowhere : {" >/dev/full", " >&-"}) {
        SCOPED_TRACE(nowhere);
        EXPECT_EQ(runByShell(folder, "", "devices --json 2>errors" + std::string(nowhere)), 1);
        EXPECT_THAT(readText(folder / "errors"), HasSubstr("error: cannot write to the standard output: "));
        EXPECT_EQ(runByShell(folder, "", quickRender + std::string(" --json 2>errors") + nowhere), 1);
        EXPECT_TRUE(fs::remove(folder / "a.exr"));
        EXPECT_EQ(runByShell(folder, "", quickRender + std::string(" --quiet 2>errors") + nowhere), 0); // control
    }
}

// A limit on files ends no command by a signal, which would leave what is half written.
TEST_F(CommandLineTest, LimitsOnFilesAreErrorsOfEveryCommand) {
    ASSERT_EQ(runByShell(folder, "", quickRender + std::string(" --quiet")), 0);
    const auto before = filesInFolder();
    for (const char* command : {"falsecolour a.exr -o f.png", "compare a.exr a.exr --html f.html"}) {
        SCOPED_TRACE(command);
        EXPECT_EQ(runByShell(folder, "ulimit -f 0;", command + std::string(" >/dev/null 2>/dev/null")), 1);
        EXPECT_EQ(filesInFolder(), before);
    }
}

} // namespace
} // namespace quasilux
