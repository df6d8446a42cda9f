#include "cli/commands.h"

#include "cli/interrupt.h"
#include "cli/started_render.h"
#include "output/progress_line.h"
#include "prepare/scene_geometry.h"
#include "scene/xml/read_files.h"
#include "util/error.h"
#include "util/messages.h"
#include "view/live_view.h"

#include <fmt/format.h>
#include <thread>

namespace quasilux {

namespace {

// A search needs a time to choose for.
constexpr double secondsOfSearched = 600;
// Without a stop rule it goes on until somebody ends it.
constexpr unsigned endless = 1u << 30;

// Renders until the page or a signal ends the program, and anew whenever the page or a file of the scene changes.
class ViewSession {
public:
    explicit ViewSession(const RenderOptions& options)
        : options_(options), progress_(stderr, !options.quiet), scene_(load()),
          device_(options.device, options.workGroupSize, options.deviceMemory), view_(options.view, interruptFlag()) {
        options_.fixed = !options_.autoAll;
        device_.keepPaces();
        StopRule& stop = options_.stop;
        isEndless_ = !stop.seconds && !stop.passes && !stop.relativeError;
        if (isEndless_ && options_.autoAll)
            stop.seconds = secondsOfSearched;
        else if (isEndless_)
            stop.passes = endless;
        isEndless_ &= !options_.autoAll;
    }

    int run() {
        view_.letEdit();
        warn(scene_->scene().warnings);
        tellEditable();
        fmt::print("{}\n", view_.address());
        std::fflush(stdout); // a program that reads it is to have it at once
        while (!interruptFlag()) {
            const auto why = failureOf([&] { renderUntilChange(); });
            if (why) {
                view_.state().setPhase("failed");
                view_.state().setProblem(*why);
            }
            if (why && !interruptFlag()) waitForChange();
            takeChanges();
        }
        progress_.clear();
        return exitCodeWhenWritten();
    }

private:
    std::unique_ptr<EditedScene> load() {
        files_ = {};
        const ReadFilesNoted noted(files_);
        return std::make_unique<EditedScene>(loadScene(options_.scene, options_.parameters(), options_.choice()));
    }

    void tellEditable() { view_.state().setEditable({scene_->lamps(), scene_->pitches(), edits_}); }

    // What the page asks for, over the command line.
    RenderOptions optionsNow() const {
        RenderOptions now = options_;
        if (edits_.bdd) now.bdd = edits_.bdd;
        if (edits_.variant) now.variant = edits_.variant;
        if (edits_.direct) now.direct = edits_.direct;
        if (edits_.map) now.map = edits_.map;
        if (edits_.map == name(MapOrder::camera)) {
            now.cameraPaths.reset();
            now.cameraSampling.reset();
        }
        if (edits_.quasiSpecular) now.quasiSpecular = edits_.quasiSpecular;
        if (edits_.bdd || edits_.variant || edits_.direct || edits_.map || edits_.quasiSpecular)
            now.caustics = caustics_;
        return now;
    }

    void warn(const std::vector<std::string>& warnings) {
        progress_.clear();
        for (const auto& warning : warnings)
            if (!options_.quiet) printWarning(warning);
    }

    // A change waits neither for the end of a pass nor for the image of the passes before, which take long where the
    // film is large.
    void renderUntilChange() {
        try {
            renderOnce();
        } catch (const RenderAbandoned&) {
        }
    }

    void renderOnce() {
        scene_->apply(edits_);
        const RenderOptions now = optionsNow();
        view_.begin(device_, scene_->scene(), now.settings(scene_->scene()), now.stop, isEndless_);
        catchInterrupt();
        const bool isKnown = learned_ && edits_.learnsAs(learnedFor_);
        if (!geometry_) geometry_ = std::make_shared<const SceneGeometry>(prepareGeometry(scene_->scene()));
        StartedRender started(now, device_, scene_->scene(), {isKnown ? learned_ : nullptr, geometry_});
        warn(started.warnings());
        view_.state().setProblem("");
        catchInterrupt(); // the runtime may have put in a handler of its own
        const auto onProgress = [&](const Progress& progress) {
            catchInterrupt();
            progress_.update(progress);
            view_.onProgress(progress);
        };
        const auto afterPass = [&](const AutoRender& soFar, const Renderer& renderer, double seconds, bool isLast) {
            keep(soFar);
            learned_ = renderer.learned();
            if (!isKnown) learnedFor_ = edits_;
            view_.afterPass(soFar, renderer, seconds, isLast);
            if (reloadIfSaved()) view_.interrupt();
            if (!isLast) return;
            progress_.clear();
            view_.waitWith(soFar, renderer, [&] { return hasNewScene(); });
        };
        const AutoRender result = started.render(onProgress, {}, view_.interrupted(), afterPass);
        if (result.failure) std::rethrow_exception(result.failure);
    }

    // What was searched once is not searched again: a change is to be seen at once. A search that a change ended has
    // chosen nothing.
    void keep(const AutoRender& soFar) {
        if (options_.fixed || soFar.search.interrupted) return;
        const RenderSettings& chosen = soFar.settings;
        options_.fixed = true;
        options_.autoAll = false;
        options_.bdd = chosen.bdd;
        options_.variant = name(chosen.variant);
        options_.quasiSpecular = chosen.quasiSpecular;
        options_.caustics = name(chosen.caustics);
        options_.photons = chosen.photonsPerPass;
        options_.cameraPaths = chosen.cameraPaths;
        options_.cameraSampling = name(chosen.cameraSampling);
        options_.radiusScale = chosen.radiusScale;
    }

    // The scene anew where a file of it has been saved. One that is wrong is said so, and the one before stays.
    bool reloadIfSaved() {
        if (!files_.haveChanged()) return false;
        const auto why = failureOf([&] { reloaded_ = load(); });
        view_.state().setProblem(why.value_or(""));
        return !why;
    }

    bool hasNewScene() { return reloaded_ || reloadIfSaved(); }

    void waitForChange() {
        while (!interruptFlag() && !view_.hasEdits() && !hasNewScene()) {
            view_.errands().dismiss();
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    }

    void takeChanges() {
        if (reloaded_) {
            if (reloaded_->lamps() != scene_->lamps()) edits_.lamps.clear(); // they go by number
            scene_ = std::move(reloaded_);
            options_.caustics = caustics_;
            learned_ = nullptr;
            geometry_ = nullptr;
            warn(scene_->scene().warnings);
        }
        if (const auto edits = view_.takeEdits()) edits_ = *edits;
        tellEditable();
    }

    RenderOptions options_;
    std::optional<std::string> caustics_ =
        options_.caustics; ///< as given: what a search found is of its method and scene
    ProgressLine progress_;
    ReadFiles files_; ///< of what was loaded last, or failed to be
    std::unique_ptr<EditedScene> scene_, reloaded_;
    bool isEndless_ = false;
    Device device_;
    LiveView view_;
    ViewEdits edits_, learnedFor_;
    std::shared_ptr<const LearnedScene> learned_;
    std::shared_ptr<const SceneGeometry> geometry_; ///< of the scene that is loaded: edits change no shapes
};

} // namespace

int viewCommand(const RenderOptions& options) {
    exitOnInterrupt();
    return ViewSession(options).run();
}

} // namespace quasilux
