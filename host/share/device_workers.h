// Devices of this process that share the passes of a render.
#pragma once

#include "share/device_worker.h"
#include "util/stopwatch.h"

#include <set>
#include <thread>

namespace quasilux {

/// One that ends no pass within so many seconds, or ten times its longest one, gives no answer any more.
inline constexpr double usualAnswerSeconds = 600;

/// Threads that gave no answer, or had not opened their device in the end, still run: the program must end without
/// waiting for them or taking from them what they use.
bool hasAbandonedThreads();

class DeviceWorkers : public PassWorkers {
public:
    explicit DeviceWorkers(double answerSeconds = usualAnswerSeconds) : answerSeconds_(answerSeconds) {}
    ~DeviceWorkers() override;
    DeviceWorkers(const DeviceWorkers&) = delete;
    DeviceWorkers& operator=(const DeviceWorkers&) = delete;

    /// The worker that comes next; `open` is called in its thread.
    void add(const std::string& name, std::function<OpenedRenderer()> open);

    std::optional<WorkerEvent> wait(double seconds) override;
    bool areOpening() const override { return !opening_.empty(); }
    void render(size_t worker, const PassRange& passes) override { members_.at(worker).worker->render(passes); }
    void giveRadii(const RadiiState& radii) override;
    void askForSums() override;
    PassSums takeSums() override;

private:
    struct Member {
        std::shared_ptr<DeviceWorker> worker;
        std::thread thread;
        bool isAlive = true;
        unsigned signs = 0; ///< when it was looked at last
        double silence = 0; ///< seconds that wait() has seen since its last sign
    };
    std::optional<WorkerEvent> note(WorkerEvent event);
    double secondsWaited();
    static void countSilence(Member& member, double seconds);
    std::optional<WorkerEvent> silentOne();
    void abandon(Member& member);
    void waitForOpening();

    double answerSeconds_;
    Stopwatch watch_;
    double lastWait_ = 0; ///< by watch_
    std::shared_ptr<WorkerEvents> events_ = std::make_shared<WorkerEvents>();
    std::vector<Member> members_;
    std::set<size_t> opening_, asked_; ///< who has not answered yet
    std::vector<size_t> gave_;
    bool isSumming_ = false;
};

} // namespace quasilux
