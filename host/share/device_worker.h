// A device with a renderer of its own, in a thread of its own.
#pragma once

#include "share/pass_workers.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

namespace quasilux {

/// What several threads say, in order.
class WorkerEvents {
public:
    void say(WorkerEvent event);
    std::optional<WorkerEvent> wait(double seconds);

private:
    std::mutex mutex_;
    std::condition_variable isThere_;
    std::deque<WorkerEvent> events_;
};

/// A device, and a renderer on it that has learned what the others know.
struct OpenedRenderer {
    std::shared_ptr<Device> device;
    std::shared_ptr<Renderer> renderer;
};

class DeviceWorker {
public:
    DeviceWorker(size_t number, std::string name, std::function<OpenedRenderer()> open,
                 std::shared_ptr<WorkerEvents> events);

    /// In a thread: until end(), or it fails. The thread holds all that it touches.
    static void run(const std::shared_ptr<DeviceWorker>& worker);

    void render(const PassRange& passes);
    void giveRadii(std::shared_ptr<const RadiiState> radii);
    void askForSums();
    void end();
    /// What it gave last; once.
    PassSums takeSums();

    const std::string& name() const { return name_; }
    bool isBusy() const { return isBusy_; }
    /// How many it has given: of a pass that ended, or of the beginning of what it does next.
    unsigned signs() const { return signs_; }
    double longestPass() const { return longestPass_; }

private:
    using Task = std::function<void(DeviceWorker&)>;
    void put(Task task);
    Task next();
    void obey();
    void doRender(const PassRange& passes);
    void doGive();
    WorkerEvent event(WorkerEvent::Kind kind) const;
    void addRadii(WorkerEvent& event);

    const size_t number_;
    const std::string name_;
    std::function<OpenedRenderer()> open_;
    std::shared_ptr<WorkerEvents> events_;
    OpenedRenderer opened_;
    bool radiiAreKnown_ = false;
    std::mutex mutex_; // of the next three
    std::condition_variable isThere_;
    std::deque<Task> tasks_;
    PassSums given_;
    std::atomic<bool> isBusy_{true}, isOver_{false};
    std::atomic<unsigned> signs_{0};
    std::atomic<double> longestPass_{0};
};

} // namespace quasilux
