// Devices that share passes, by their threads alone: of one that opens no device for as long as the test wants it to.
#include "share/device_workers.h"

#include <chrono>
#include <future>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

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
