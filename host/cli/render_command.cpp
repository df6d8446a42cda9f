// The stages of a render: check the outputs, load, prepare, render, write, summarise.
#include "cli/render_command.h"

#include "cli/command_end.h"
#include "cli/interrupt.h"
#include "cli/render_report.h"
#include "cli/render_scene.h"
#include "cli/render_warnings.h"
#include "cli/started_render.h"
#include "cli/terminal_picture.h"
#include "cli/text_table.h"
#include "cli/written_files.h"
#include "output/atomic_file.h"
#include "output/exr.h"
#include "output/grid_csv.h"
#include "output/meter_reading.h"
#include "output/progress_line.h"
#include "output/statistics.h"
#include "ranks/job.h"
#include "util/error.h"
#include "util/messages.h"
#include "util/process_memory.h"
#include "util/stopwatch.h"
#include "view/live_view.h"
#include "view/tev_client.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

// When warnings are said: those before the first pass end a strict render, those after it only its exit code.
enum class Moment { beforePasses, whenWritten };

void say(const RenderOptions& options, const std::vector<std::string>& warnings) {
    if (!options.quiet || options.strict)
        for (const auto& warning : warnings) printWarning(warning);
}

/// The end of a strict render before its first pass, for which no device is to blame.
struct StrictEnd : std::runtime_error {
    using runtime_error::runtime_error;
};

void endIfStrict(const RenderOptions& options, const std::vector<std::string>& messages, Moment moment) {
    if (!options.strict || messages.empty()) return;
    const char* which = messages.size() == 1 ? "the warning above is an error" : "the warnings above are errors";
    if (moment == Moment::beforePasses) throw StrictEnd(fmt::format("--strict: {}, nothing is rendered", which));
    throw std::runtime_error(fmt::format("--strict: {}; the files have been written", which));
}

void warn(const RenderOptions& options, const std::vector<std::string>& warnings) {
    say(options, warnings);
    endIfStrict(options, warnings, Moment::beforePasses);
}

/// The curve of the PNG, if there is one.
std::optional<ToneCurve> writeFiles(const RenderOptions& options, const FilmImage& image,
                                    const std::vector<AovImage>& aovs, RenderRecord& record, WrittenFiles& written) {
    const Stopwatch watch;
    std::optional<ToneCurve> curve;
    const std::string path = options.outputPath();
    written.write(path, [&] { writeExr(path, image, record, aovs); });
    written.write(options.grid, [&] { writeGridCsv(options.grid, image, record); });
    written.write(options.png, [&] {
        const ToneCurve chosen = chooseToneCurve(image, options.exposure);
        writePng(options.png, image, chosen, record);
        curve = chosen;
    });
    record.writeSeconds = watch.seconds();
    written.write(options.stats, [&] { writeJson(options.stats, statisticsJson(record, image)); });
    return curve;
}

void printJsonSummary(const RenderRecord& record, const FilmImage& image, const std::vector<std::string>& files,
                      const std::optional<ToneCurve>& curve) {
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
                           {"workers", workersJson(record.workers)},
                           {"files", files}};
    if (curve) summary["exposure"] = {{"scale", curve->scale}, {"white", curve->white}};
    if (record.meter != MeterKind::none) summary["meter"] = meterJson(record, image);
    fmt::print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

// After the passes: the estimated error, then a table by component. Docs: docs/method/accuracy.md.
void printErrorTable(const ErrorEstimate& error) {
    if (!error.isKnown()) { // after one pass nothing is known
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

void printWorkers(const std::vector<WorkerRecord>& workers) {
    if (workers.empty()) return;
    TextTable table({"passes rendered by", "passes", "passes/s", "dropped since"});
    for (const WorkerRecord& one : workers)
        table.add({one.name, std::to_string(one.passes),
                   one.seconds > 0 ? fmt::format("{:.3g}", one.timed / one.seconds) : "", one.failure});
    fmt::print("{}", table.text());
}

void printSummary(const RenderRecord& record, const FilmImage& image, const std::vector<std::string>& files,
                  const std::optional<ToneCurve>& curve) {
    fmt::print("{} {}, {:.1f} s", record.counters.passes, record.counters.passes == 1 ? "pass" : "passes",
               record.counters.renderSeconds);
    if (record.interrupted) fmt::print(", interrupted");
    if (!record.failure.empty()) fmt::print(", ended by a failure");
    printErrorTable(record.error);
    printWorkers(record.workers);
    if (record.meter != MeterKind::none) fmt::print("{}", meterText(record, image));
    for (const auto& path : files) fmt::print("wrote {}\n", path);
    if (curve)
        fmt::print("exposure scale {:.6g} per {}, white at {:.6g}\n", curve->scale,
                   record.settings.photometric ? "cd/m2" : "W sr^-1 m^-2", curve->white);
}

/// A render that is over, and what it needs while its files are written.
struct Finished {
    RenderScene loaded;
    std::shared_ptr<Device> device; ///< one that has not failed
    std::unique_ptr<StartedRender> started;
    AutoRender render;
    bool isStopped = false;            ///< by the page of the live view
    bool isOutdated = false;           ///< given up, as its scene has changed
    std::vector<std::string> warnings; ///< of the passes, to be said when the files are written
};

class SensorRender {
public:
    SensorRender(const RenderOptions& options, const RenderSurroundings& around)
        : options_(options), around_(around), progress_(stderr, !options.quiet && around.drawsProgress, around.label) {}
    int run();

private:
    void load();
    void render(const std::vector<DeviceChoice>& devices);
    void renderOnFirstThatCan();
    bool isShared(const std::vector<DeviceChoice>& devices) const {
        return devices.size() > 1 || Job::current().size() > 1;
    }
    void onChosen(const SearchReport& search);
    std::vector<AovImage> layers(WrittenFiles& written);
    void summarise(const RenderRecord& record, WrittenFiles& written, const std::optional<ToneCurve>& curve) const;
    int finish();

    const RenderOptions& options_;
    const RenderSurroundings& around_;
    ProgressLine progress_;
    Finished done_;
};

void SensorRender::load() {
    progress_.update({.phase = "loading"});
    done_.loaded = loadRenderScene(options_);
    progress_.clear();
    warn(options_, done_.loaded.warnings);
}

void SensorRender::onChosen(const SearchReport& search) {
    progress_.clear();
    // Where nothing can be searched, only who asked for it need know.
    if (!options_.quiet && (search.notSearched.empty() ? search.freedom.any() : options_.autoAll))
        printNote(search.line());
}

void SensorRender::render(const std::vector<DeviceChoice>& devices) {
    const Scene& scene = *done_.loaded.scene;
    done_.started.reset(); // of a device before
    done_.device = openDevice(options_, devices.front());
    exitOnInterrupt();
    progress_.update({.phase = "preparing"});
    std::optional<LiveView> view;
    done_.started = std::make_unique<StartedRender>(options_, *done_.device, scene);
    StartedRender& started = *done_.started;
    progress_.clear();
    warn(options_, started.warnings());
    catchInterrupt();
    if (options_.isViewed) {
        view.emplace(options_.view, interruptFlag());
        view->begin(*done_.device, scene, options_.settings(scene), started.stop(), false);
        printNote("live view at " + view->address());
    }
    std::optional<TevClient> tev;
    if (options_.tev) {
        tev.emplace(*options_.tev, nameOfShown(options_), *done_.device);
        warn(options_, tev->takeWarnings());
    }
    std::atomic<bool> isOver{false}; // where the scene is watched
    const auto onProgress = [&](const Progress& now) {
        catchInterrupt();
        progress_.update(now);
        if (view) view->onProgress(now);
        done_.isOutdated = done_.isOutdated || (around_.isOutdated && around_.isOutdated());
        isOver = done_.isOutdated || interruptFlag();
    };
    const auto afterPass = [&](const AutoRender& soFar, const Renderer& now, double seconds, bool isLast) {
        if (view) view->afterPass(soFar, now, seconds, isLast);
        if (tev) tev->afterPass(now, isLast);
    };
    const std::atomic<bool>& interrupted = view ? view->interrupted() : around_.isOutdated ? isOver : interruptFlag();
    const SharedDevices shared{done_.device, devices, done_.loaded.scene};
    if (isShared(devices)) started.share(shared);
    done_.render = started.render(
        onProgress, [&](const SearchReport& search) { onChosen(search); }, interrupted, afterPass);
    done_.isStopped = view && view->isStopped();
    // The image is there, whether a device that lives can be opened once more or not.
    if (isShared(devices)) failureOf([&] { done_.device = livingDevice(options_, shared, done_.render); });
    if (!tev) return;
    tev->finish();
    for (std::string& warning : tev->takeWarnings()) done_.warnings.push_back(std::move(warning));
}

// One that cannot learn what all need is dropped like one that fails later. What fails on all of them, as a wrong
// option does, is said once.
void SensorRender::renderOnFirstThatCan() {
    for (auto devices = ownDevices(options_);; devices.erase(devices.begin())) {
        if (devices.size() == 1)
            render(devices);
        else if (const auto why = refusal([&] { render(devices); })) {
            done_.warnings.push_back(fmt::format("{} is dropped: {}", text(devices.front()), *why));
            continue;
        }
        return progress_.clear();
    }
}

// Of a device that has failed there may be none: the image is there all the same.
std::vector<AovImage> SensorRender::layers(WrittenFiles& written) {
    std::vector<AovImage> found;
    const auto why = failureOf([&] { found = renderLayers(*done_.device, *done_.loaded.scene, done_.render); });
    if (why)
        written.addFailure(std::make_exception_ptr(std::runtime_error(
            "the layers of what is met first are left out, as they could not be rendered: " + *why)));
    return found;
}

void SensorRender::summarise(const RenderRecord& record, WrittenFiles& written,
                             const std::optional<ToneCurve>& curve) const {
    const auto& files = written.paths();
    written.attempt([&] {
        if (options_.json)
            printJsonSummary(record, done_.render.image, files, curve);
        else if (!options_.quiet)
            printSummary(record, done_.render.image, files, curve);
    });
}

int SensorRender::run() {
    exitOnInterrupt();
    checkOutputs(options_);
    try {
        load();
        renderOnFirstThatCan();
    } catch (const StrictEnd& end) {
        throw InputError(end.what());
    }
    if (done_.isOutdated && !interruptFlag()) return exitCodeOutdated;
    if (done_.render.image.passes > 0) return finish();
    if (done_.isStopped && !options_.quiet)
        printWarning("stopped by the page of the live view before the first pass was over: there is no image");
    if (interruptFlag() || done_.isStopped) return exitCodeWithoutResult();
    throw std::runtime_error("no pass was rendered before the stop rule was reached");
}

int SensorRender::finish() {
    const AutoRender& render = done_.render;
    const FilmImage& image = render.image;
    progress_.update({.phase = "writing"});
    RenderRecord record =
        makeRecord(*done_.loaded.scene, done_.started->stop(), *done_.device, render, interruptFlag());
    record.loadSeconds = done_.loaded.seconds;
    record.unobstructedIlluminance = done_.loaded.daylight;
    record.interrupted |= done_.isStopped;
    WrittenFiles written;
    if (render.failure) written.addFailure(render.failure);
    const auto aovs = layers(written);
    record.peakHostBytes = peakResidentBytes(); // of these, too
    const auto curve =
        writeFiles(options_.named(namePartsOf(record.settings.seed, image.passes)), image, aovs, record, written);
    progress_.clear();
    summarise(record, written, curve);
    std::vector<std::string> warnings = renderWarnings(record.counters, record.report, image);
    warnings.insert(warnings.end(), done_.warnings.begin(), done_.warnings.end());
    if (!options_.show.empty())
        if (const auto why = showImage(options_.show, image, options_.exposure)) warnings.push_back(*why);
    // What there is has been written. Warnings come last: there they are seen.
    say(options_, warnings);
    if (const auto why = done_.started->checkpointFailure(); !why.empty())
        written.addFailure(
            std::make_exception_ptr(std::runtime_error("no checkpoint of the last passes could be written: " + why)));
    written.rethrow();
    const auto& amidPasses = done_.started->warningsAmidPasses(); // have been said
    warnings.insert(warnings.end(), amidPasses.begin(), amidPasses.end());
    endIfStrict(options_, warnings, Moment::whenWritten);
    return exitCodeWhenWritten();
}

int renderSensors(const RenderOptions& options, const RenderSurroundings& around) {
    if (options.sensor != "all") return SensorRender(options, around).run();
    if (!options.grid.empty())
        throw InputError({options.scene}, "--grid measures the illuminance-grid instead of a sensor; give it without "
                                          "--sensor all.");
    if (!options.resume.empty())
        throw InputError(
            fmt::format("--resume {}: a checkpoint is of one sensor; give --sensor with its number.", options.resume));
    const size_t count =
        loadScene(options.scene, options.parameters(), {"0", options.unknown(), options.loadLimits()}).sensorCount;
    for (size_t index = 0; index < count; ++index) {
        const int code = withResultsOut(SensorRender(options.forSensor(index), around).run());
        if (code != 0 || interruptFlag()) return code;
    }
    return 0;
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
    Job& job = Job::current();
    if ((options.isViewed || options.tev) && (job.size() > 1 || ownDevices(options).size() > 1))
        throw InputError(fmt::format("{} shows the passes of one device, and several are named: leave one of both out",
                                     options.isViewed ? "--view" : "--tev"));
    if (job.rank() == 0) return renderSensors(options, around);
    assistJob(options);
    return 0;
}

} // namespace quasilux
