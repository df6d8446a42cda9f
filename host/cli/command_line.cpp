// Parses the command line, runs the command, and turns what it throws into messages and exit codes.
#include "cli/command_line.h"

#include "cli/command_end.h"
#include "cli/commands.h"
#include "cli/option_checks.h"
#include "cli/option_list.h"
#include "cli/options.h"
#include "cli/render_queue.h"
#include "ranks/job.h"
#include "scene/gltf/gltf_document.h"
#include "share/device_workers.h"
#include "util/file_ending.h"
#include "util/messages.h"
#include "util/nearest.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <unistd.h>

namespace quasilux {

namespace {

int fail(int exitCode, const std::string& message) {
    if (launchedAs().rank > 0) return exitCode; // rank 0 says it
    printError(message);
    return exitCode;
}

// Where tev listens by itself.
constexpr const char* ownTev = "--tev=127.0.0.1:14158";

/// `quasilux SCENE …` is `quasilux render SCENE …`; and --tev without HOST:PORT has one, so that it takes no scene for
/// that.
std::vector<std::string> completed(CLI::App& app, std::vector<std::string> arguments) {
    const auto commands = listedCommands(app);
    const auto isFirst = [&](const CLI::App* command) { return command->get_name() == arguments[0]; };
    if (!arguments.empty() && std::none_of(commands.begin(), commands.end(), isFirst)) {
        const std::filesystem::path path(arguments[0]);
        std::error_code ignored;
        if (fileEnding(arguments[0]) == ".xml" || isGltf(arguments[0]) ||
            std::filesystem::is_regular_file(path, ignored))
            arguments.insert(arguments.begin(), "render");
    }
    for (size_t k = 0; k < arguments.size(); ++k)
        if (arguments[k] == "--tev" && (k + 1 == arguments.size() || !isHostAndPort(arguments[k + 1])))
            arguments[k] = ownTev;
    return arguments;
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

/// CLI11's own words, but for options that are given too often.
std::string wordsOf(const CLI::ParseError& error) {
    std::string text = error.what();
    const std::string often = ": At Most 1 required but received ";
    const size_t at = text.find(often);
    if (at == std::string::npos) return text;
    return fmt::format("{} is given {} times; give it once", text.substr(0, at), text.substr(at + often.size()));
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
                                   : wordsOf(error));
    printTo(stderr, fmt::format("`quasilux {}--help` lists the options\n", noCommand ? "" : command.get_name() + " "));
    return exitBadInput;
}

int runCommand(CLI::App& app, const Options& options) {
    if (app.got_subcommand("render")) return renderScenes(options.render);
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

// Without standard streams (`2>&-`) the next files that are opened would get their numbers, and messages would be
// written into them. One that can be read alone is no place to write to, so that results which nobody gets still are a
// failure.
void openStandardStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", O_RDONLY) < 0) return;
}

// A file that exceeds a limit, and a pipe that nobody reads, are to fail with an error code, not to end the program.
void ignoreSignalsOfFiles() {
    for (const int signal : {SIGXFSZ, SIGPIPE}) std::signal(signal, SIG_IGN);
}

int parseAndRun(CLI::App& app, const Options& options, int argc, char** argv) {
    const CommandEnd end = endOf([&] {
        try {
            std::vector<std::string> arguments = completed(app, {argv + 1, argv + argc});
            std::reverse(arguments.begin(), arguments.end()); // as CLI11 takes them
            app.parse(std::move(arguments));
        } catch (const CLI::ParseError& error) {
            return failParsing(app, error);
        }
        return withResultsOut(runCommand(app, options));
    });
    return end.error.empty() ? end.exitCode : fail(end.exitCode, end.error);
}

} // namespace

int runCommandLine(int argc, char** argv) {
    openStandardStreams();
    ignoreSignalsOfFiles();
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
