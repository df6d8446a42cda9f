#include "cli/commands.h"

#include "cli/interrupt.h"
#include "cli/render_warnings.h"
#include "cli/started_render.h"
#include "cli/text_table.h"
#include "output/atomic_file.h"
#include "output/progress_line.h"
#include "report/decisive_points.h"
#include "report/figure_text.h"
#include "report/report_page.h"
#include "util/error.h"
#include "util/messages.h"
#include "util/stopwatch.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

// Shares of the time that is left when their turn comes; what a part does not need the next ones have.
constexpr double directShare = 0.25, observerShare = 1, gridShare = 3, pictureShare = 0.5;
// Of the precision asked for: the direct light at an eye is subtracted from all.
constexpr double directNoise = 0.2;
constexpr unsigned manyPasses = 1u << 30;
// Passes before figures are looked at, and how many more of them before they are again.
constexpr unsigned firstLook = 16;
constexpr double nextLook = 1.1;

/// Renders the parts of a report one after the other.
class ReportMaker {
public:
    explicit ReportMaker(const ReportOptions& options)
        : options_(options), progress_(stderr, !options.quiet),
          scene_(loadScene(options.scene, options.parameters(), choiceOf(options))),
          device_(options.device, options.workGroupSize, options.deviceMemory),
          photometric_(options.settings(scene_).photometric) {}

    /// As far as it came; nothing where it was interrupted before any figure.
    ReportContent make() {
        for (const auto& warning : scene_.warnings) warn(warning);
        content_.scene = std::filesystem::path(options_.scene).filename().string();
        content_.device = device_.info().name;
        content_.precision = options_.precision;
        content_.hasSky = scene_.surroundings || !scene_.directionalEmitters.empty();
        content_.luminaires = luminairesOf(scene_, photometric_);
        content_.otherLamps = otherLamps();
        if (content_.luminaires.empty() && content_.otherLamps == 0)
            throw InputError({options_.scene}, "the scene has no light, so that every figure of a report is 0 or "
                                               "unknown; add an emitter, or turn one on.");
        const bool hasPicture = scene_.sensor.meter == MeterKind::none;
        sharesLeft_ = (directShare + observerShare) * static_cast<double>(observers().size()) +
                      (scene_.grids.empty() ? 0 : gridShare) + (hasPicture ? pictureShare : 0);
        // Observers are soon known, and leave their time to the grids; what those leave a picture can always use.
        for (const Observer& observer : observers()) attempt([&] { measureObserver(observer); });
        if (!scene_.grids.empty()) attempt([&] { measureOwnGrids(); });
        if (hasPicture) attempt([&] { takePicture(); });
        if (failure_ && isEmpty()) std::rethrow_exception(failure_);
        if (isInterrupted())
            warn("the report was interrupted: parts of it are missing, or rendered for a shorter time");
        content_.seconds = seconds();
        progress_.clear();
        return std::move(content_);
    }

    /// What ended the report before all of its parts were there; null: nothing.
    std::exception_ptr failure() const { return failure_; }

private:
    using Enough = std::function<bool(const Renderer&)>;

    bool isOver() const { return isInterrupted() || failure_; }

    /// One of the parts. A device that fails loses none of what is there.
    template <typename Part>
    void attempt(const Part& part) {
        if (isOver()) return;
        try {
            part();
        } catch (const InputError&) {
            throw;
        } catch (...) {
            endBy(std::current_exception());
        }
    }

    void endBy(const std::exception_ptr& failure) {
        failure_ = failure;
        const auto why = failureOf([&] { std::rethrow_exception(failure); });
        warn("parts of the report are missing, or rendered for a shorter time, as a device failed: " + *why);
    }

    bool isEmpty() const { return content_.observers.empty() && content_.grids.empty() && !content_.picture; }

    static LoadChoice choiceOf(const ReportOptions& options) {
        LoadChoice choice = options.choice();
        choice.observersSuffice = true;
        return choice;
    }

    double seconds() const { return watch_.seconds(); }
    static bool isInterrupted() { return interruptFlag(); }

    void warn(const std::string& message) {
        progress_.clear();
        if (!options_.quiet) printWarning(message);
        if (std::find(content_.warnings.begin(), content_.warnings.end(), message) == content_.warnings.end())
            content_.warnings.push_back(message);
    }

    size_t otherLamps() const {
        const auto isLuminaire = [](const PointEmitter& emitter) { return emitter.luminaire.has_value(); };
        const auto shapes = std::count_if(scene_.shapes.begin(), scene_.shapes.end(),
                                          [](const auto& shape) { return shape.emitter.has_value(); });
        const auto points =
            scene_.pointEmitters.size() -
            static_cast<size_t>(std::count_if(scene_.pointEmitters.begin(), scene_.pointEmitters.end(), isLuminaire));
        return points + static_cast<size_t>(shapes) + scene_.directionalEmitters.size() + (scene_.surroundings ? 1 : 0);
    }

    bool hasLamps() const {
        return !scene_.pointEmitters.empty() ||
               std::any_of(scene_.shapes.begin(), scene_.shapes.end(),
                           [](const auto& shape) { return shape.emitter.has_value(); });
    }
    /// Without lamps there is nothing that glares by night.
    std::vector<Observer> observers() const { return hasLamps() ? scene_.observers : std::vector<Observer>{}; }

    /// When a part with this share ends that begins now, in seconds().
    double endOf(double share) {
        const double now = seconds(), end = now + std::max(0.0, options_.seconds - now) * share / sharesLeft_;
        sharesLeft_ = std::max(sharesLeft_ - share, 1e-9);
        return end;
    }

    uint64_t seed() const { return options_.settings(scene_).seed; }

    /// Until `end`; `isEnough` is asked after each pass.
    AutoRender render(const Scene& scene, double end, RenderedPart& part, const Enough& isEnough,
                      std::optional<uint64_t> otherSeed = {}) {
        const double begun = seconds();
        RenderOptions options;
        static_cast<SceneOptions&>(options) = options_;
        if (otherSeed) options.seed = otherSeed;
        // A search wants to know its time; others end by `isEnough` or when the time is over, though not before there
        // is an error.
        const bool endsByTime = scene.sensor.meter == MeterKind::none;
        if (endsByTime)
            options.stop.seconds = std::max(end - begun, 1e-3);
        else
            options.stop.passes = manyPasses;
        std::atomic<bool> ends = false;
        const auto onProgress = [&](Progress now) {
            catchInterrupt();
            if (isInterrupted()) ends = true;
            if (!endsByTime) now.secondsLeft = -1; // that until manyPasses
            progress_.update(now);
        };
        StartedRender started(options, device_, scene);
        for (const auto& warning : started.warnings()) warn(warning);
        catchInterrupt();
        const auto afterPass = [&](const AutoRender&, const Renderer& renderer, double, bool) {
            if (renderer.counters().passes == 0) return;
            const bool isLate = seconds() > end && renderer.counters().passes >= fewestBatches;
            if (isEnough(renderer) || isLate || isInterrupted()) ends = true;
        };
        AutoRender result = started.render(onProgress, {}, ends, afterPass);
        part.passes = result.image.passes;
        part.seconds = seconds() - begun;
        if (result.failure) endBy(result.failure);
        for (const auto& warning : renderWarnings(result.counters, result.report, result.image)) warn(warning);
        return result;
    }

    /// Adds each pass to the readings until `isKnown` says so.
    void measure(const Scene& scene, double end, RenderedPart& part, BatchedReadings& readings,
                 const std::function<bool()>& isKnown, std::optional<uint64_t> otherSeed = {}) {
        double look = firstLook;
        const AutoRender result = render(
            scene, end, part,
            [&](const Renderer& renderer) {
                readings.add(renderer.develop());
                if (readings.passes() < look) return false;
                look = nextLook * readings.passes();
                return isKnown();
            },
            otherSeed);
        noteSettings(result, "of figures");
    }

    /// All together: they share photons. Then points that may be the darkest or brightest again, where that is less work
    /// than to go on with all.
    void measureOwnGrids() {
        Scene scene = scene_;
        useGridsAsSensor(scene);
        MeasuredGrids measured(photometric_);
        measured.ranges = rangesOf(scene.grids);
        const double end = endOf(gridShare);
        std::optional<std::vector<DecisivePoints>> decisive;
        const auto areAllKnown = [&] {
            for (size_t k = 0; k < measured.ranges.size(); ++k)
                if (!areKnown(measured.figures(k), options_.precision)) return false;
            return true;
        };
        measure(scene, end, measured.rendered, measured.readings, [&] {
            if (areAllKnown()) return true;
            decisive = decisivePoints(measured.readings, measured.ranges, options_.precision);
            return decisive.has_value();
        });
        if (decisive && !isOver() && seconds() < end) {
            Scene points = scene_;
            points.grids = gridsOf(scene.grids, *decisive);
            useGridsAsSensor(points);
            measured.extremeRanges = extremeRanges(*decisive);
            measure(points, end, measured.again, measured.extremes, areAllKnown, ~seed()); // independent of the others
        }
        if (measured.rendered.passes == 0) return; // interrupted
        for (size_t k = 0; k < measured.ranges.size(); ++k)
            content_.grids.push_back(gridPart(scene.grids, k, measured));
    }

    struct MeasuredGrids {
        explicit MeasuredGrids(bool photometric) : readings(photometric), extremes(photometric) {}

        std::vector<PixelRange> ranges;
        RenderedPart rendered, again;
        BatchedReadings readings, extremes;       ///< `extremes`: of points that may be extreme, measured again
        std::vector<ExtremeRanges> extremeRanges; ///< empty: none were

        bool isAgain() const { return extremes.passes() >= fewestBatches; }
        NormFigures figures(size_t k) const {
            return isAgain() ? normFigures(readings, ranges[k], extremes, extremeRanges[k])
                             : normFigures(readings, ranges[k]);
        }
    };

    static GridPart gridPart(const std::vector<IlluminanceGrid>& grids, size_t k, const MeasuredGrids& measured) {
        const auto& ranges = measured.ranges;
        const auto& readings = measured.readings;
        const IlluminanceGrid& grid = grids[k];
        GridPart part;
        static_cast<RenderedPart&>(part) = measured.rendered;
        if (measured.isAgain()) {
            part.again = measured.again;
            part.pointsAgain = measured.extremeRanges[k].least.count + measured.extremeRanges[k].largest.count;
        }
        part.name = grid.name;
        part.isCylindrical = grid.kind == IlluminanceKind::cylindrical;
        part.figures = measured.figures(k);
        const auto means = readings.means();
        const auto first = means.begin() + static_cast<std::ptrdiff_t>(ranges[k].first);
        part.values = {grid.nx,
                       grid.ny,
                       glm::length(grid.edgeU),
                       glm::length(grid.edgeV),
                       {first, first + static_cast<std::ptrdiff_t>(ranges[k].count)},
                       {},
                       "lx"};
        if (const auto twin = horizontalTwin(grids, k)) {
            part.modelling = ratioOfMeans(readings, ranges[k], ranges[*twin]);
            part.modellingAtPoints = modellingAtPoints(readings, ranges[k], ranges[*twin]);
        }
        return part;
    }

    void measureObserver(const Observer& observer) {
        if (!occlusion_) occlusion_ = std::make_unique<Occlusion>(scene_);
        const GlareSources sources = glareSources(scene_, observer, *occlusion_, photometric_);
        BatchedReadings direct(photometric_), all(photometric_);
        ObserverPart part;
        {
            Scene scene = scene_;
            measureAtEye(scene, observer, EyeLight::direct);
            // Less than the noise of the rest.
            measure(scene, endOf(directShare), part, direct, [&] {
                return direct.figure([](const auto& points) { return points.front(); }).relativeHalfWidth() <
                       directNoise * options_.precision;
            });
        }
        if (isOver()) return;
        const RenderedPart ofDirect = part;
        Scene scene = scene_;
        measureAtEye(scene, observer, EyeLight::all);
        measure(scene, endOf(observerShare), part, all,
                [&] { return isKnown(observerFigures(observer, sources, direct, all), options_.precision); });
        if (part.passes == 0) return; // interrupted
        part.seconds += ofDirect.seconds;
        part.figures = observerFigures(observer, sources, direct, all);
        part.figures.observer.position += scene.origin; // where the file has it
        content_.observers.push_back(std::move(part));
    }

    void takePicture() {
        PicturePart part;
        const AutoRender result = render(scene_, endOf(pictureShare), part, [](const Renderer&) { return false; });
        const FilmImage& image = result.image;
        if (image.passes == 0) return; // interrupted
        part.luminance = luminanceImage(image.width, image.height, image.radiance,
                                        image.isErrorKnown() ? image.standardError : std::vector<float>(),
                                        photometric_ ? 1 : luminousEfficacy);
        part.toneMapped = toneMap(image, chooseToneCurve(image, {}));
        part.error = estimateError(image);
        content_.picture = std::move(part);
        noteSettings(result, "of the picture");
    }

    void noteSettings(const AutoRender& render, const std::string& what) {
        const RenderSettings& chosen = render.settings;
        const auto note = [&](const std::string& name, const std::string& value) {
            if (std::find(content_.settings.begin(), content_.settings.end(), std::pair(name, value)) ==
                content_.settings.end())
                content_.settings.emplace_back(name, value);
        };
        note("device", device_.info().name);
        note("units of radiance", photometric_ ? "cd/m²" : "W sr⁻¹ m⁻², 683 lm/W");
        note("seed", std::to_string(seed()));
        note("method " + what,
             fmt::format("{}, BDD {}, quasi-specular {}, direct light by {}, {} photons a pass", name(chosen.variant),
                         chosen.bdd, chosen.quasiSpecular, name(chosen.direct), render.report.photonsPerPass));
    }

    const ReportOptions& options_;
    Stopwatch watch_;
    ProgressLine progress_;
    Scene scene_;
    Device device_;
    bool photometric_;
    std::unique_ptr<Occlusion> occlusion_;
    double sharesLeft_ = 1;
    ReportContent content_;
    std::exception_ptr failure_;
};

} // namespace

int reportCommand(const ReportOptions& options) {
    exitOnInterrupt();
    checkOutputPath(options.output, "--output", ".html");
    ReportMaker maker(options);
    const ReportContent content = maker.make();
    writeText(options.output, reportPage(content));
    if (options.json) {
        fmt::print("{}\n", reportJson(content).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else if (!options.quiet) {
        fmt::print("{}", tableText(figureRows(content)));
        if (!content.isKnown())
            fmt::print("not every figure is known to {:g} % (95 %): give more --time\n", 100 * content.precision);
        fmt::print("{:.1f} s\nwrote {}\n", content.seconds, options.output);
    }
    if (maker.failure()) std::rethrow_exception(maker.failure());
    return exitCodeWhenWritten();
}

} // namespace quasilux
