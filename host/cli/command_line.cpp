#include "cli/command_line.h"

#include "cli/devices_command.h"
#include "cli/info_command.h"
#include "cli/options.h"
#include "cli/render_command.h"
#include "util/nearest.h"

#include <fmt/format.h>
#include <new>

namespace quasilux {

namespace {

constexpr int exitFailed = 1, exitBadInput = 2;

int fail(int exitCode, const std::string& message) {
    fmt::print(stderr, "quasilux: error: {}\n", message);
    return exitCode;
}

/// The subcommand that was named, or the program itself.
CLI::App& chosenCommand(CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

/// "unknown argument '--sed', did you mean '--seed'?"
std::string unknownArguments(CLI::App& app) {
    CLI::App& command = chosenCommand(app);
    std::vector<std::string> known;
    for (const auto* option : command.get_options())
        for (const auto& name : option->get_lnames()) known.push_back("--" + name);
    for (const auto* subcommand : command.get_subcommands([](CLI::App*) { return true; }))
        known.push_back(subcommand->get_name());
    const auto extras = app.remaining(true);
    if (extras.empty()) return "unexpected argument";
    const std::string near = nearestName(extras.front(), known);
    return fmt::format("unknown argument '{}'{}", extras.front(), near.empty() ? "" : ", did you mean '" + near + "'?");
}

int failParsing(CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help and --version
    const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
    fail(exitBadInput, unknown ? unknownArguments(app) : error.what());
    CLI::App& command = chosenCommand(app);
    fmt::print(stderr, "`quasilux {}--help` lists the options\n", &command == &app ? "" : command.get_name() + " ");
    return exitBadInput;
}

int runCommand(CLI::App& app, const Options& options) {
    if (app.got_subcommand("render")) return renderCommand(options.render);
    if (app.got_subcommand("info"))
        infoCommand(options.info);
    else
        listDevicesCommand(options.devicesJson);
    return 0;
}

} // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app(
        "Renders images by bidirectional Monte Carlo ray tracing with photon maps and quasi-specular elements, "
        "on any OpenCL device.",
        "quasilux");
    Options options;
    declareOptions(app, options);
    try {
        app.parse(argc, argv);
        return runCommand(app, options);
    } catch (const CLI::ParseError& error) {
        return failParsing(app, error);
    } catch (const InputError& error) {
        return fail(exitBadInput, error.what());
    } catch (const std::bad_alloc&) {
        return fail(exitFailed, "the computer's memory is exhausted, try a smaller image or scene");
    } catch (const std::exception& error) {
        return fail(exitFailed, error.what());
    }
}

} // namespace quasilux
