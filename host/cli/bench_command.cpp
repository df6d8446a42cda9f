// Renders every scene by every method on every device, then reports.
#include "cli/commands.h"

#include "bench/bench_report.h"
#include "bench/micro/micro_bench.h"
#include "cli/bench_parts.h"
#include "cli/interrupt.h"
#include "cli/option_checks.h"
#include "cli/text_table.h"
#include "output/atomic_file.h"
#include "output/progress_line.h"
#include "output/statistics.h"
#include "util/error.h"
#include "util/messages.h"

#include <cstdlib>
#include <fmt/format.h>

namespace quasilux {

namespace {

std::array<double, 3> loadAverage() {
    std::array<double, 3> load{};
    if (getloadavg(load.data(), 3) != 3) load = {};
    return load;
}

std::vector<BenchMethod> chooseMethods(const BenchOptions& options) {
    if (options.methods.empty() && options.hasParts()) return {};
    if (options.methods.empty()) return defaultBenchMethods();
    std::vector<BenchMethod> methods;
    for (const auto& text : options.methods) methods.push_back(parseBenchMethod(text));
    return methods;
}

std::vector<Scene> loadScenes(const BenchOptions& options) {
    std::vector<Scene> scenes;
    for (const auto& path : options.scenes)
        scenes.push_back(loadScene(path, parseDefinitions(options.definitions),
                                   {{}, options.lenient ? Unknown::forgiven : Unknown::refused}));
    return scenes;
}

/// Counts must agree, and sizes of references with those of their scenes' films.
void readReferences(const BenchOptions& options, const std::vector<Scene>& scenes, BenchReport& report) {
    if (!options.references.empty() && options.references.size() != options.scenes.size())
        throw InputError(fmt::format("--reference is given {} times for {} scenes; give one for each scene, - for none",
                                     options.references.size(), options.scenes.size()));
    if (!options.referenceNoise.empty() && options.referenceNoise.size() != options.references.size())
        throw InputError(fmt::format("--reference-noise is given {} times for {} references; give one for each",
                                     options.referenceNoise.size(), options.references.size()));
    for (size_t k = 0; k < options.references.size(); ++k) {
        if (options.references[k] == "-") continue;
        BenchReference reference{readRadiance(options.references[k]), 0};
        if (!options.referenceNoise.empty()) reference.noise = options.referenceNoise[k];
        const Sensor& sensor = scenes[k].sensor;
        if (reference.image.width != sensor.width || reference.image.height != sensor.height)
            throw InputError(fmt::format("{} is {} x {}, the film of {} {} x {}; they must agree",
                                         options.references[k], reference.image.width, reference.image.height,
                                         options.scenes[k], sensor.width, sensor.height));
        report.references.emplace(options.scenes[k], std::move(reference));
    }
}

void runAll(const BenchOptions& options, const std::vector<Scene>& scenes, const std::vector<BenchMethod>& methods,
            const std::vector<int>& devices, Attempts& attempts, BenchReport& report) {
    ProgressLine line(stderr, !options.quiet);
    const size_t total = scenes.size() * methods.size() * devices.size();
    size_t begun = 0;
    for (size_t s = 0; s < scenes.size(); ++s)
        for (const BenchMethod& method : methods)
            for (size_t d = 0; d < devices.size(); ++d) {
                const std::string& name = options.scenes[s];
                const auto reference = report.references.find(name);
                Progress progress;
                progress.phase = fmt::format("{} of {}: {}, {}", ++begun, total, name, method.name);
                const auto onProgress = [&](unsigned passes, double seconds) {
                    catchInterrupt();
                    progress.passes = passes;
                    progress.seconds = seconds;
                    progress.secondsLeft = std::max(0.0, options.seconds - seconds);
                    line.update(progress);
                };
                attempts.run(fmt::format("{}, {}, device {}", name, method.name, d), [&] {
                    line.update(progress);
                    auto run = measureRun(devices[d], scenes[s], method, options.seconds,
                                          reference == report.references.end() ? nullptr : &reference->second,
                                          onProgress, interruptFlag());
                    run.scene = name;
                    run.device = d;
                    report.runs.push_back(std::move(run));
                });
            }
}

void runMicroParts(const BenchOptions& options, const std::vector<std::string>& parts, BenchReport& report) {
    ProgressLine line(stderr, !options.quiet);
    MicroSettings settings;
    settings.device = options.devices.empty() ? -1 : options.devices.front();
    settings.parts = parts;
    const auto onProgress = [&](const std::string& what) {
        catchInterrupt();
        Progress progress;
        progress.phase = what;
        line.update(progress);
    };
    report.micro = runMicro(settings, onProgress, interruptFlag());
}

void printTables(const BenchReport& report) {
    fmt::print("{:g} s a run, load average {:.1f} before, {:.1f} after{}\n\n", report.seconds, report.loadBefore[0],
               report.loadAfter[0], report.interrupted ? ", interrupted" : "");
    for (const std::string& scene : scenesOf(report)) {
        fmt::print("{}\n", scene);
        fmt::print("{}\n", tableText(runRows(report, scene)));
        fmt::print("{}\n", tableText(stageRows(report, scene)));
        fmt::print("{}\n", tableText(deviceRows(report, scene)));
    }
    for (const BenchSection& section : report.sections)
        for (const BenchTable& table : section.tables)
            fmt::print("{}: {}\n{}{}\n\n", section.title, table.title, tableText(table.rows), table.note);
    if (!report.micro) return;
    for (const std::string& part : partsOf(*report.micro))
        fmt::print("{}\n", tableText(microTable(*report.micro, part)));
}

} // namespace

int benchCommand(const BenchOptions& options) {
    exitOnInterrupt();
    if (!options.output.empty()) checkOutputPath(options.output, "--output", ".json");
    if (!options.html.empty()) checkOutputPath(options.html, "--html", ".html");
    checkParts(options);
    const auto microNames = options.micro ? parseMicroParts(*options.micro) : std::vector<std::string>{};
    const auto methods = chooseMethods(options);
    const auto scenes = loadScenes(options);
    BenchReport report;
    report.seconds = options.seconds;
    readReferences(options, scenes, report);
    const std::vector<int> devices = options.devices.empty() ? std::vector<int>{-1} : options.devices;
    for (const int device : devices) report.devices.push_back(Device(device).info());
    report.loadBefore = loadAverage();
    Attempts attempts(report.failures);
    runAll(options, scenes, methods, devices, attempts, report);
    runParts(options, scenes, devices, attempts, report.sections);
    if (options.micro) attempts.run("micro", [&] { runMicroParts(options, microNames, report); });
    report.loadAfter = loadAverage();
    report.interrupted = interruptFlag();
    if (report.runs.empty() && report.sections.empty() && (!report.micro || report.micro->rows.empty())) {
        if (!interruptFlag()) attempts.rethrowFirst();
        return exitCodeWithoutResult();
    }

    if (!options.output.empty()) writeJson(options.output, benchJson(report));
    if (!options.html.empty()) writeText(options.html, benchPage(report));
    if (options.json)
        fmt::print("{}\n", benchJson(report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else if (!options.quiet)
        printTables(report);
    for (const BenchFailure& failure : report.failures)
        printError(fmt::format("{}: {}", failure.what, failure.message));
    return report.failures.empty() ? exitCodeWhenWritten() : 1;
}

} // namespace quasilux
