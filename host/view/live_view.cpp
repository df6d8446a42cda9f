#include "view/live_view.h"

#include "render/film_cut.h"
#include "util/error.h"
#include "view/browser.h"
#include "view/frame.h"
#include "view/server.h"

#include <filesystem>
#include <thread>

namespace quasilux {

namespace {

constexpr std::chrono::milliseconds whileWaiting{10};
// That the first pass of a render has for itself.
constexpr std::chrono::seconds ofFirstPass{1};

} // namespace

LiveView::LiveView(const ViewOptions& options, const std::atomic<bool>& signalled)
    : signalled_(signalled), server_(std::make_unique<ViewServer>(options, *this)) {
    if (options.opensBrowser && hasDesktop()) page_ = std::make_unique<OpenedPage>(address());
}

LiveView::~LiveView() {
    if (device_) device_->watchLaunches({});
    state_.close();
    errands_.close();
    server_.reset(); // before what it uses
}

std::string LiveView::address() const { return server_->address(); }

void LiveView::begin(Device& device, const Scene& scene, const RenderSettings& settings, const StopRule& stop,
                     bool isEndless) {
    if (device_ != &device) cutter_ = std::make_unique<FilmCutter>(device);
    device_ = &device;
    scene_ = &scene;
    device.watchLaunches([this] { giveUpIfOutdated(); });
    passes_ = 0;
    begun_.reset();
    isStopped_ = false;
    ++renders_;
    errands_.hurry(); // its first picture is not put off
    interrupted_ = false;
    if (signalled_ || hasEdits_)
        interrupted_ = true; // an edit that comes now is not lost: edit() says so before it interrupts
    record_ = {};
    record_.scene = std::filesystem::path(scene.path).filename().string();
    record_.device = device.info();
    record_.workGroupSize = device.workGroupSize();
    record_.stop = stop;
    record_.isPerNanometre = scene.surroundings && scene.surroundings->isPerNanometre;
    record_.meter = scene.sensor.meter;
    record_.view = imageViewOf(scene.sensor);
    record_.pixelFormat = scene.sensor.pixelFormat;
    state_.begin({record_.scene, scene.sensor.width, scene.sensor.height, isEndless, isIrradiance(scene.sensor.meter)});
    state_.setSettings(settings);
}

void LiveView::onProgress(const Progress& progress) {
    syncSignal();
    state_.setProgress(progress);
}

void LiveView::afterPass(const AutoRender& soFar, const Renderer& renderer, double seconds, bool isLast) {
    syncSignal();
    passes_ = static_cast<unsigned>(renderer.counters().passes);
    if (passes_ == 0) begun_ = Clock::now();
    const auto onRows = [this, &renderer, &soFar] {
        giveUpIfOutdated();
        doErrands({renderer, soFar, ++moment_, true, true});
    };
    renderer.film().watchRows(isLast ? std::function<void()>() : onRows, errands_.areAwaited());
    if (isLast) device_->watchLaunches({});
    const char* over = isStopped_ ? "stopped" : "done";
    if (passes_ == 0) { // the method has been chosen
        state_.setSettings(soFar.settings);
        state_.setLayers(layersOf(renderer.film().layout()));
        state_.setPhase(isLast ? over : "rendering");
        return;
    }
    state_.setPasses(passes_, seconds);
    if (isLast) state_.setPhase(over);
    doErrands({renderer, soFar, ++moment_, !isLast});
    if (hasEdits_ && !isLast) throw RenderAbandoned();
}

void LiveView::giveUpIfOutdated() const {
    if (!hasEdits_ || isInErrands_) return;
    const bool isInFirstPass = begun_ && passes_ == 0;
    if (isInFirstPass && (areDrafts_ || Clock::now() < *begun_ + ofFirstPass)) return;
    throw RenderAbandoned();
}

void LiveView::doErrands(const RenderMoment& moment) {
    isInErrands_ = true; // what these launch is not given up
    errands_.doDue(moment);
    isInErrands_ = false;
}

void LiveView::waitWith(const AutoRender& soFar, const Renderer& renderer, const std::function<bool()>& isOver) {
    while (!signalled_ && !hasEdits_ && !isOver()) {
        doErrands({renderer, soFar, moment_, false});
        std::this_thread::sleep_for(whileWaiting);
    }
}

std::optional<ViewEdits> LiveView::takeEdits() {
    const std::lock_guard lock(mutex_);
    hasEdits_ = false;
    return std::exchange(edits_, std::nullopt);
}

void LiveView::stop() {
    isStopped_ = true;
    interrupted_ = true;
}

uint64_t LiveView::edit(const ViewEdits& edits) {
    const std::lock_guard lock(mutex_);
    edits_ = edits;
    edits_->number = ++editsSoFar_;
    areDrafts_ = edits.isDraft;
    hasEdits_ = true;
    interrupted_ = true;
    return editsSoFar_;
}

LiveView::Saved LiveView::saved(const RenderMoment& moment) const {
    Saved saved{moment.renderer.develop(), record_};
    saved.record.settings = moment.soFar.settings;
    saved.record.search = moment.soFar.search;
    saved.record.report = moment.renderer.report();
    saved.record.counters = moment.renderer.counters();
    saved.record.interrupted = isStopped_;
    return saved;
}

std::vector<AovImage> LiveView::layers(const RenderMoment& moment) {
    std::vector<AovImage> found;
    const auto why = failureOf([&] { found = moment.renderer.layers(*scene_); });
    if (why) state_.setProblem("the layers of what is met first are left out, as they could not be rendered: " + *why);
    return found;
}

} // namespace quasilux
