// Devices that share passes, by their threads alone: of one that opens no device for as long as the test wants it to.
#include "share/device_workers.h"

#include "util/stopwatch.h"

#include <chrono>
#include <future>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <thread>

namespace quasilux {
namespace {

using testing::HasSubstr;

/// Holds what opens a device until it is let go.
class Gate {
public:
    ~Gate() { open(); }
    void open() {
        if (!std::exchange(isOpen_, true)) promise_.set_value();
    }
    std::function<OpenedRenderer()> opener() const {
        return [gate = gate_]() -> OpenedRenderer {
            gate.wait();
            throw std::runtime_error("no device");
        };
    }

private:
    std::promise<void> promise_;
    std::shared_future<void> gate_ = promise_.get_future().share();
    bool isOpen_ = false;
};

/// What it says within a minute, asked every few milliseconds.
std::optional<WorkerEvent> nextEvent(DeviceWorkers& workers) {
    const Stopwatch watch;
    while (watch.seconds() < 60)
        if (auto event = workers.wait(0.02)) return event;
    return std::nullopt;
}

// A program that is stopped (Ctrl-Z) sees its devices say nothing, as the clock runs on.
TEST(DeviceWorkers, TimeThatNobodyWaitsInIsNoSilence) {
    Gate gate;
    DeviceWorkers workers(2.5);
    workers.add("a", gate.opener());
    EXPECT_FALSE(workers.wait(0.02));
    std::this_thread::sleep_for(std::chrono::seconds(4));
    EXPECT_FALSE(workers.wait(0.02));
    const auto event = nextEvent(workers); // control: one that is waited for
    ASSERT_TRUE(event);
    EXPECT_EQ(event->kind, WorkerEvent::Kind::failed);
    EXPECT_EQ(event->name, "a");
    EXPECT_THAT(event->why, HasSubstr("no answer for 2.5 s"));
}

// What has been rendered is to be written, however long another device takes to be opened.
TEST(DeviceWorkers, EndWithoutThoseThatAreOpened) {
    Gate gate;
    auto workers = std::make_unique<DeviceWorkers>();
    workers->add("a", gate.opener());
    EXPECT_FALSE(workers->wait(0.02));
    const auto end = std::async(std::launch::async, [&] { workers.reset(); });
    EXPECT_EQ(end.wait_for(std::chrono::seconds(60)), std::future_status::ready);
    gate.open(); // else a failure would hang
    EXPECT_TRUE(hasAbandonedThreads());
}

} // namespace
} // namespace quasilux
