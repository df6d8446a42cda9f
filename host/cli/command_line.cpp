// Parses the command line, runs the command, and turns what it throws into messages and exit codes.
#include "cli/command_line.h"

#include "cli/commands.h"
#include "cli/options.h"
#include "ranks/job.h"
#include "share/device_workers.h"
#include "util/error.h"
#include "util/nearest.h"

#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <new>

namespace quasilux {

namespace {

constexpr int exitFailed = 1, exitBadInput = 2;

int fail(int exitCode, const std::string& message) {
    if (launchedAs().rank > 0) return exitCode; // rank 0 says it
    fmt::print(stderr, "quasilux: error: {}\n", message);
    return exitCode;
}

/// The subcommand that was named, or the program itself.
CLI::App& chosenCommand(CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

/// "unknown argument '--sed', did you mean '--seed'?", for the first argument that no option or command took.
std::string unknownArgument(CLI::App& app) {
    CLI::App& command = chosenCommand(app);
    std::vector<std::string> known;
    for (const auto* option : command.get_options())
        for (const auto& name : option->get_lnames()) known.push_back("--" + name);
    for (const auto* subcommand : command.get_subcommands([](CLI::App*) { return true; }))
        known.push_back(subcommand->get_name());
    const std::string unknown = app.remaining(true).front();
    const std::string near = nearestName(unknown, known);
    return fmt::format("unknown argument '{}'{}", unknown, near.empty() ? "" : ", did you mean '" + near + "'?");
}

int failParsing(CLI::App& app, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error); // --help and --version
    CLI::App& command = chosenCommand(app);
    const bool noCommand = &command == &app;
    // A misspelt command counts as an unknown argument, although CLI11 says only that a command is missing.
    const bool unknown =
        !app.remaining(true).empty() && (noCommand || dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr);
    fail(exitBadInput, unknown     ? unknownArgument(app)
                       : noCommand ? "no command given, expected render, view, merge, compare, photometry, "
                                     "falsecolour, report, dgp, bench, devices, doctor, manual or info"
                                   : error.what());
    fmt::print(stderr, "`quasilux {}--help` lists the options\n", noCommand ? "" : command.get_name() + " ");
    return exitBadInput;
}

int runCommand(CLI::App& app, const Options& options) {
    if (app.got_subcommand("render")) return renderCommand(options.render);
    if (app.got_subcommand("view")) return viewCommand(options.view);
    if (app.got_subcommand("merge")) return mergeCommand(options.merge);
    if (app.got_subcommand("bench")) return benchCommand(options.bench);
    if (app.got_subcommand("compare")) return compareCommand(options.compare);
    if (app.got_subcommand("photometry")) return photometryCommand(options.photometry);
    if (app.got_subcommand("dgp")) return dgpCommand(options.dgp);
    if (app.got_subcommand("report")) return reportCommand(options.report);
    if (app.got_subcommand("falsecolour")) return falseColourCommand(options.falseColour);
    if (app.got_subcommand("doctor")) return doctorCommand(options.doctorJson);
    if (app.got_subcommand("manual"))
        manualCommand(app, options.manualFolder);
    else if (app.got_subcommand("info"))
        infoCommand(options.info);
    else
        listDevicesCommand(options.devicesJson);
    return 0;
}

} // namespace

namespace {

int parseAndRun(CLI::App& app, const Options& options, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        return runCommand(app, options);
    } catch (const CLI::ParseError& error) {
        return failParsing(app, error);
    } catch (const InputError& error) {
        return fail(exitBadInput, error.what());
    } catch (const std::bad_alloc&) {
        return fail(exitFailed, memoryExhausted);
    } catch (const std::exception& error) {
        return fail(exitFailed, error.what());
    }
}

} // namespace

int runCommandLine(int argc, char** argv) {
    CLI::App app(
        "Renders images by bidirectional Monte Carlo ray tracing with photon maps and quasi-specular elements, "
        "on any OpenCL device.",
        "quasilux");
    Options options;
    declareOptions(app, options);
    const int code = parseAndRun(app, options, argc, argv);
    Job::endCurrent();
    if (!hasAbandonedThreads()) return code;
    std::fflush(nullptr);
    std::_Exit(code); // a device that gives no answer keeps a thread, and what is destroyed now would be taken from it
}

} // namespace quasilux
