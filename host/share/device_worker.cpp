#include "share/device_worker.h"

#include "util/error.h"
#include "util/stopwatch.h"

namespace quasilux {

void WorkerEvents::say(WorkerEvent event) {
    {
        const std::scoped_lock lock(mutex_);
        events_.push_back(std::move(event));
    }
    isThere_.notify_one();
}

std::optional<WorkerEvent> WorkerEvents::wait(double seconds) {
    std::unique_lock lock(mutex_);
    isThere_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return !events_.empty(); });
    if (events_.empty()) return std::nullopt;
    WorkerEvent event = std::move(events_.front());
    events_.pop_front();
    return event;
}

DeviceWorker::DeviceWorker(size_t number, std::string name, std::function<OpenedRenderer()> open,
                           std::shared_ptr<WorkerEvents> events)
    : number_(number), name_(std::move(name)), open_(std::move(open)), events_(std::move(events)) {}

void DeviceWorker::run(const std::shared_ptr<DeviceWorker>& worker) {
    const auto why = failureOf([&] { worker->obey(); });
    worker->isBusy_ = false;
    if (!why || worker->isOver_) return;
    WorkerEvent event = worker->event(WorkerEvent::Kind::failed);
    event.name = worker->name_;
    event.why = *why;
    worker->events_->say(std::move(event));
}

void DeviceWorker::obey() {
    opened_ = open_();
    open_ = {};
    WorkerEvent opened = event(WorkerEvent::Kind::opened);
    opened.name = name_;
    if (opened_.renderer->radiiAreChosen()) addRadii(opened);
    events_->say(std::move(opened));
    while (const Task task = next()) task(*this);
}

DeviceWorker::Task DeviceWorker::next() {
    std::unique_lock lock(mutex_);
    isBusy_ = false;
    isThere_.wait(lock, [this] { return !tasks_.empty() || isOver_; });
    if (isOver_) return {};
    ++signs_;
    isBusy_ = true;
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    return task;
}

void DeviceWorker::put(Task task) {
    {
        const std::scoped_lock lock(mutex_);
        tasks_.push_back(std::move(task));
    }
    isThere_.notify_one();
}

void DeviceWorker::render(const PassRange& passes) {
    put([passes](DeviceWorker& worker) { worker.doRender(passes); });
}

void DeviceWorker::giveRadii(std::shared_ptr<const RadiiState> radii) {
    put([radii = std::move(radii)](DeviceWorker& worker) {
        worker.radiiAreKnown_ = true;
        if (!worker.opened_.renderer->radiiAreChosen()) worker.opened_.renderer->restoreRadii(radii->state);
    });
}

void DeviceWorker::askForSums() {
    put([](DeviceWorker& worker) { worker.doGive(); });
}

void DeviceWorker::end() {
    {
        const std::scoped_lock lock(mutex_);
        isOver_ = true;
    }
    isThere_.notify_one();
}

PassSums DeviceWorker::takeSums() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(given_, {});
}

void DeviceWorker::doRender(const PassRange& passes) {
    Renderer& renderer = *opened_.renderer;
    const Stopwatch watch;
    const auto before = renderer.counters();
    WorkerEvent rendered = event(WorkerEvent::Kind::rendered);
    for (unsigned pass = passes.first; pass < passes.end && !isOver_; ++pass) {
        const Stopwatch ofPass;
        renderer.renderPass(pass);
        const double seconds = ofPass.seconds();
        longestPass_ = std::max<double>(longestPass_, seconds);
        rendered.squaredSeconds += seconds * seconds;
        ++signs_;
    }
    rendered.passes = passes;
    rendered.seconds = watch.seconds();
    rendered.photons = renderer.counters().photonsEmitted - before.photonsEmitted;
    rendered.paths = renderer.counters().cameraPaths - before.cameraPaths;
    if (renderer.radiiAreChosen()) addRadii(rendered);
    events_->say(std::move(rendered));
}

void DeviceWorker::doGive() {
    const Stopwatch watch;
    PassSums sums = quasilux::takeSums(*opened_.device, *opened_.renderer);
    WorkerEvent gave = event(WorkerEvent::Kind::gave);
    addRadii(gave);
    gave.seconds = watch.seconds();
    {
        const std::scoped_lock lock(mutex_);
        given_ = std::move(sums);
    }
    events_->say(std::move(gave));
}

WorkerEvent DeviceWorker::event(WorkerEvent::Kind kind) const {
    WorkerEvent one;
    one.kind = kind;
    one.worker = number_;
    return one;
}

void DeviceWorker::addRadii(WorkerEvent& event) {
    if (radiiAreKnown_) return;
    auto radii = std::make_shared<RadiiState>();
    radii->areChosen = opened_.renderer->radiiAreChosen();
    opened_.renderer->saveRadii(radii->state);
    radiiAreKnown_ = radii->areChosen;
    event.radii = std::move(radii);
}

} // namespace quasilux
