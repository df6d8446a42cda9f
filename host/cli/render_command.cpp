// The stages of a render: check the outputs, load, prepare, render, write, summarise.
#include "cli/render_command.h"

#include "cli/interrupt.h"
#include "cli/render_report.h"
#include "cli/render_warnings.h"
#include "cli/started_render.h"
#include "cli/terminal_picture.h"
#include "cli/text_table.h"
#include "output/atomic_file.h"
#include "output/exr.h"
#include "output/grid_csv.h"
#include "output/meter_reading.h"
#include "output/progress_line.h"
#include "output/statistics.h"
#include "util/error.h"
#include "util/messages.h"
#include "view/live_view.h"
#include "view/tev_client.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct WrittenFiles {
    std::vector<std::string> paths;
    std::optional<ToneCurve> curve; ///< of the PNG
};

// When warnings are said: those before the first pass end a strict render, those after it only its exit code.
enum class Moment { beforePasses, whenWritten };

void warn(const RenderOptions& options, const std::vector<std::string>& messages,
          Moment moment = Moment::beforePasses) {
    if (!options.quiet || options.strict)
        for (const auto& message : messages) printWarning(message);
    if (!options.strict || messages.empty()) return;
    const char* which = messages.size() == 1 ? "the warning above is an error" : "the warnings above are errors";
    if (moment == Moment::beforePasses) throw InputError(fmt::format("--strict: {}, nothing is rendered", which));
    throw std::runtime_error(fmt::format("--strict: {}; the files have been written", which));
}

WrittenFiles writeFiles(const RenderOptions& options, const Scene& scene, const FilmImage& image,
                        const std::vector<AovImage>& aovs, RenderRecord& record) {
    const auto start = Clock::now();
    WrittenFiles written;
    if (const std::string path = options.outputPath(); !path.empty()) {
        writeExr(path, image, record, aovs);
        written.paths.push_back(path);
    }
    if (!options.grid.empty()) {
        IlluminanceGrid grid = *scene.grid;
        grid.origin += scene.origin; // where the file has it
        writeGridCsv(options.grid, grid, image, record);
        written.paths.push_back(options.grid);
    }
    if (!options.png.empty()) {
        written.curve = chooseToneCurve(image, options.exposure);
        writePng(options.png, image, *written.curve, record);
        written.paths.push_back(options.png);
    }
    record.writeSeconds = secondsSince(start);
    if (!options.stats.empty()) {
        writeJson(options.stats, statisticsJson(record, image));
        written.paths.push_back(options.stats);
    }
    return written;
}

void printJsonSummary(const RenderRecord& record, const FilmImage& image, const WrittenFiles& written) {
    nlohmann::json summary{{"version", record.version},
                           {"scene", record.scene},
                           {"device", record.device.name},
                           {"passes", record.counters.passes},
                           {"seconds", record.counters.renderSeconds},
                           {"relativeError", record.error.sum()},
                           {"error", errorJson(record.error)},
                           {"auto", record.search.line()},
                           {"interrupted", record.interrupted},
                           {"failure", record.failure.empty() ? nlohmann::json() : nlohmann::json(record.failure)},
                           {"nonFinite", record.counters.nonFinite},
                           {"cutPaths", record.counters.cutPaths},
                           {"files", written.paths}};
    if (written.curve) summary["exposure"] = {{"scale", written.curve->scale}, {"white", written.curve->white}};
    if (record.meter != MeterKind::none) summary["meter"] = meterJson(record, image);
    fmt::print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

// After the passes: the estimated error, then a table by component. Docs: docs/method/accuracy.md.
void printErrorTable(const ErrorEstimate& error) {
    if (!std::isfinite(error.sum())) { // after one pass nothing is known
        fmt::print("\n");
        return;
    }
    fmt::print(", estimated relative error {:.3g} %{}\n", 100 * error.sum(),
               error.hasBias ? "" : " (noise only: the bias is not estimated here)");
    TextTable table({"relative error", "noise: mean", "95 % of pixels below", "rms", "bias: rms"});
    const auto add = [&](const std::string& name, const ErrorPart& part) {
        const auto percent = [](double ratio) { return fmt::format("{:.3g} %", 100 * ratio); };
        table.add({name, percent(part.noiseMean), percent(part.noisePercentile95), percent(part.noiseRms),
                   error.hasBias ? percent(part.biasRms) : "unknown"});
    };
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
        if (error.components[c].noiseRms > 0) add(componentName(c), error.components[c]);
    add("total", error.total);
    fmt::print("{}", table.text());
}

std::string nameOfShown(const RenderOptions& options) {
    const std::string path = options.outputPath().empty() ? options.scene : options.outputPath();
    return std::filesystem::path(path).filename().string();
}

void printSummary(const RenderRecord& record, const FilmImage& image, const WrittenFiles& written) {
    fmt::print("{} {}, {:.1f} s", record.counters.passes, record.counters.passes == 1 ? "pass" : "passes",
               record.counters.renderSeconds);
    if (record.interrupted) fmt::print(", interrupted");
    if (!record.failure.empty()) fmt::print(", ended by a failure");
    printErrorTable(record.error);
    if (record.meter != MeterKind::none) fmt::print("{}", meterText(record, image));
    for (const auto& path : written.paths) fmt::print("wrote {}\n", path);
    if (written.curve)
        fmt::print("exposure scale {:.6g} per W sr^-1 m^-2, white at {:.6g}\n", written.curve->scale,
                   written.curve->white);
}

int renderSensor(const RenderOptions& options, const RenderSurroundings& around) {
    exitOnInterrupt();
    checkOutputs(options);
    ProgressLine progress(stderr, !options.quiet && around.drawsProgress, around.label);
    progress.update({.phase = "loading"});
    const auto start = Clock::now();
    Scene scene = loadScene(options.scene, options.parameters(), options.choice());
    if (!options.grid.empty()) measureGrid(scene);
    const double loadSeconds = secondsSince(start);
    progress.clear();
    warn(options, scene.warnings);
    std::vector<std::string> ofSky;
    const auto daylight = skyOfDaylightFactor(options, scene, ofSky);
    warn(options, ofSky);

    Device device(options.device, options.workGroupSize, options.deviceMemory);
    exitOnInterrupt();
    progress.update({.phase = "preparing"});
    std::optional<LiveView> view;
    std::atomic<bool> isOver{false}; // where the scene is watched
    bool isOutdated = false;
    const auto onProgress = [&](const Progress& now) {
        catchInterrupt();
        progress.update(now);
        if (view) view->onProgress(now);
        isOutdated = isOutdated || (around.isOutdated && around.isOutdated());
        isOver = isOutdated || interruptFlag();
    };
    const auto onChosen = [&](const SearchReport& search) {
        progress.clear();
        // Where nothing can be searched, only who asked for it need know.
        if (!options.quiet && (search.notSearched.empty() ? search.freedom.any() : options.autoAll))
            fmt::print(stderr, "quasilux: {}\n", search.line());
    };
    StartedRender started(options, device, scene);
    progress.clear();
    warn(options, started.warnings());
    catchInterrupt();
    if (options.isViewed) {
        view.emplace(options.view, interruptFlag());
        view->begin(device, scene, options.settings(scene), started.stop(), false);
        fmt::print(stderr, "quasilux: live view at {}\n", view->address());
    }
    std::optional<TevClient> tev;
    if (options.tev) {
        tev.emplace(*options.tev, nameOfShown(options), device);
        warn(options, tev->takeWarnings());
    }
    const auto afterPass = [&](const AutoRender& soFar, const Renderer& now, double seconds, bool isLast) {
        if (view) view->afterPass(soFar, now, seconds, isLast);
        if (tev) tev->afterPass(now, isLast);
    };
    const std::atomic<bool>& interrupted = view ? view->interrupted() : around.isOutdated ? isOver : interruptFlag();
    const AutoRender render = started.render(onProgress, onChosen, interrupted, afterPass);
    if (isOutdated && !interruptFlag()) return exitCodeOutdated;
    const FilmImage& image = render.image;
    if (image.passes == 0) {
        if (interruptFlag()) return exitCodeWithoutResult();
        throw std::runtime_error("no pass was rendered before the stop rule was reached");
    }

    progress.update({.phase = "writing"});
    RenderRecord record = makeRecord(scene, started.stop(), device, render, interruptFlag());
    record.loadSeconds = loadSeconds;
    record.unobstructedIlluminance = daylight;
    record.interrupted |= view && view->isStopped();
    const WrittenFiles written = writeFiles(options.named(namePartsOf(record.settings.seed, image.passes)), scene,
                                            image, renderLayers(device, scene, render), record);
    progress.clear();
    if (options.json)
        printJsonSummary(record, image, written);
    else if (!options.quiet)
        printSummary(record, image, written);
    if (!options.show.empty()) showImage(options.show, image, options.exposure);
    std::vector<std::string> warnings =
        renderWarnings(record.counters, record.report, uint64_t{image.width} * image.height);
    if (tev) tev->finish();
    if (tev)
        for (std::string& warning : tev->takeWarnings()) warnings.push_back(std::move(warning));
    // What there is has been written. Warnings come last: there they are seen.
    if (render.failure) std::rethrow_exception(render.failure);
    if (!started.checkpointFailure().empty())
        throw std::runtime_error("no checkpoint of the last passes could be written: " + started.checkpointFailure());
    warn(options, warnings, Moment::whenWritten);
    return exitCodeWhenWritten();
}

} // namespace

void checkOutputs(const RenderOptions& options) {
    const NameParts any = namePartsOf(0, 0); // the names are not known yet, their folders are
    const RenderOptions named = options.named(any);
    if (!named.outputPath().empty()) checkOutputPath(named.outputPath(), "--output", ".exr");
    if (!named.grid.empty()) checkOutputPath(named.grid, "--grid", ".csv");
    if (!named.png.empty()) checkOutputPath(named.png, "--png", ".png");
    if (!named.stats.empty()) checkOutputPath(named.stats, "--stats", ".json");
    checkCheckpointOptions(options);
}

int renderCommand(const RenderOptions& options, const RenderSurroundings& around) {
    if (options.sensor != "all") return renderSensor(options, around);
    if (!options.grid.empty())
        throw InputError({options.scene}, "--grid measures the illuminance-grid instead of a sensor; give it without "
                                          "--sensor all.");
    if (!options.resume.empty())
        throw InputError(
            fmt::format("--resume {}: a checkpoint is of one sensor; give --sensor with its number.", options.resume));
    const size_t count = loadScene(options.scene, options.parameters(), {"0", options.unknown()}).sensorCount;
    for (size_t index = 0; index < count; ++index)
        if (const int code = renderSensor(options.forSensor(index), around); code != 0 || interruptFlag()) return code;
    return 0;
}

} // namespace quasilux
