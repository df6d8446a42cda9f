// A render that is watched by a page in the browser: between the render loop, which calls it after each pass, and the
// server (docs/guide/live-view.md).
#pragma once

#include "auto/auto_render.h"
#include "output/render_record.h"
#include "view/edits.h"
#include "view/errands.h"
#include "view/live_state.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace quasilux {

class FilmCutter;
class OpenedPage;
class ViewServer;

struct ViewOptions {
    std::string listen = "127.0.0.1";
    unsigned port = 0;        ///< 0: any that is free
    bool opensBrowser = true; ///< where there is a desktop
};

class LiveView {
public:
    /// Listens from now on. `signalled`: set by signals that end the program. Throws InputError where the address
    /// cannot be had.
    LiveView(const ViewOptions& options, const std::atomic<bool>& signalled);
    ~LiveView();

    /// What the page is opened with; its token is as good as a key.
    std::string address() const;
    /// Ends a render, for a signal, the page's stop button, or since something else is to be rendered.
    const std::atomic<bool>& interrupted() const { return interrupted_; }
    /// Whether somebody pressed stop since begin().
    bool isStopped() const { return isStopped_; }

    LiveState& state() { return state_; }
    /// `scene` has to last and stay as it is while the render goes on. From now on launches on the device throw
    /// RenderAbandoned where an edit has come, and afterPass() does. The first pass has a second for itself, and if the
    /// edit is a draft all the time that it takes: or else nothing would be seen where edits follow each other. A stop
    /// waits for the end of the pass, and keeps it.
    void begin(Device& device, const Scene& scene, const RenderSettings& settings, const StopRule& stop,
               bool isEndless);
    /// Both are called by the thread that renders.
    void onProgress(const Progress& progress);
    void afterPass(const AutoRender& soFar, const Renderer& renderer, double seconds, bool isLast);
    /// Its render is over, but the view goes on until somebody wants something else, or `isOver()`: errands are done
    /// meanwhile.
    void waitWith(const AutoRender& soFar, const Renderer& renderer, const std::function<bool()>& isOver);

    /// What the page asked for since the last call.
    std::optional<ViewEdits> takeEdits();
    bool hasEdits() const { return hasEdits_; }
    /// The running render is to end.
    void interrupt() { interrupted_ = true; }

    /// Only looked at, unless this is called once.
    void letEdit() { isEditable_ = true; }

    // For the server.
    /// How many have begun.
    uint64_t renders() const { return renders_; }
    bool isEditable() const { return isEditable_; }
    Errands& errands() { return errands_; }
    FilmCutter& cutter() { return *cutter_; }
    void stop();
    /// The number that they have.
    uint64_t edit(const ViewEdits& edits);
    /// The image as it is, with what headers say of it.
    struct Saved {
        FilmImage image;
        RenderRecord record;
    };
    Saved saved(const RenderMoment& moment) const;
    /// What else its EXR has: the layers of integrator `aov`, and alpha. Where they cannot be made the page says so,
    /// and the image goes without.
    std::vector<AovImage> layers(const RenderMoment& moment);

private:
    using Clock = std::chrono::steady_clock;

    void syncSignal() {
        if (signalled_) interrupted_ = true;
    }
    void giveUpIfOutdated() const;
    void doErrands(const RenderMoment& moment);

    const std::atomic<bool>& signalled_;
    std::atomic<bool> interrupted_{false}, isStopped_{false}, hasEdits_{false}, areDrafts_{false}, isEditable_{false};
    std::atomic<uint64_t> renders_{0};
    std::mutex mutex_;
    std::optional<ViewEdits> edits_;
    uint64_t editsSoFar_ = 0;
    LiveState state_;
    Errands errands_;
    std::unique_ptr<FilmCutter> cutter_;
    Device* device_ = nullptr;
    const Scene* scene_ = nullptr; ///< that is rendered
    RenderRecord record_;          ///< what is known at the beginning
    uint64_t moment_ = 0;
    unsigned passes_ = 0;                    ///< of the render
    std::optional<Clock::time_point> begun_; ///< its first pass
    bool isInErrands_ = false;
    std::unique_ptr<ViewServer> server_;
    std::unique_ptr<OpenedPage> page_;
};

} // namespace quasilux
