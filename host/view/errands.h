// What others want of a render while it goes on: done by the thread that renders, between two passes, as nobody else
// may use the device.
#pragma once

#include "auto/auto_render.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <mutex>

namespace quasilux {

/// A render between two passes.
struct RenderMoment {
    const Renderer& renderer;
    const AutoRender& soFar; ///< settings and search
    uint64_t number;         ///< of the moment: one more after each pass, or more rows of it, whatever the render
    bool goesOn = true;      ///< or else no pass follows, so that time does not matter
    bool inPass = false;     ///< in the middle of one
};

class Errands {
public:
    using Clock = std::chrono::steady_clock;
    using Errand = std::function<void(const RenderMoment&)>;

    /// When it is to be done.
    struct Due {
        uint64_t after = 0;            ///< at a moment with a larger number
        Clock::time_point notBefore{}; ///< not earlier
        bool inPasses = false; ///< or in the middle of a pass, when some rows of the film have it and others not
    };

    /// Waits until the errand is done: true. Or until `patience` ends or close() is called: false, and it is not done
    /// any more. Throws what the errand throws.
    bool run(Errand errand, const Due& due, std::chrono::milliseconds patience);

    /// The thread that renders: does what is due. Nothing but a look at a number where nobody wants anything.
    void doDue(const RenderMoment& moment);
    /// Whether somebody waits now.
    bool areAwaited() const { return waiting_ > 0; }
    /// What waits for its time need not any more.
    void hurry();
    /// Wakes all who wait: there is no picture for them now.
    void dismiss();
    /// Wakes all who wait, for good.
    void close();

private:
    struct Entry {
        Errand errand;
        Due due;
        bool isDone = false, isDismissed = false;
        std::exception_ptr failure;
    };

    std::mutex mutex_; ///< held while errands are done: nobody gives up meanwhile
    std::condition_variable done_;
    std::list<Entry*> entries_; ///< of those who wait, on their stacks
    std::atomic<size_t> waiting_{0};
    bool isClosed_ = false;
};

} // namespace quasilux
