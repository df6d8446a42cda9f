// What Python has to say while a render goes on: Ctrl-C and the callback.
#pragma once

#include "render/renderer.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <pybind11/pybind11.h>

namespace quasilux {

/// The handlers of signals as they were. An OpenCL runtime that compiles in this process may put in handlers of its own
/// (PoCL's LLVM does, when it looks for devices), with which Python would not learn of Ctrl-C.
class SignalHandlers {
public:
    SignalHandlers();
    void putBack() const;

protected:
    static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};

private:
    std::array<struct sigaction, signals.size()> before_{};
};

/// While it lives, such signals wait: for what puts in handlers that would end the process.
class DelayedSignals : SignalHandlers {
public:
    DelayedSignals();
    ~DelayedSignals();
    DelayedSignals(const DelayedSignals&) = delete;
    DelayedSignals& operator=(const DelayedSignals&) = delete;

private:
    sigset_t before_{};
};

/// Made and destroyed with the GIL; look() and onProgress() are called without it.
class RenderWatch {
public:
    /// `callback`: None, or called with the Progress; what returns False ends the render.
    explicit RenderWatch(pybind11::object callback) : callback_(std::move(callback)) {}

    /// Lets Python run the handlers of signals that have come.
    void look();
    void onProgress(const Progress& progress);

    const std::atomic<bool>& interrupted() const { return interrupted_; }
    /// The exception that a signal or the callback has raised, which ends the render; None: none.
    const pybind11::object& raised() const { return raised_; }

private:
    using Clock = std::chrono::steady_clock;
    template <typename Action>
    void inPython(const Action& action);

    pybind11::object callback_, raised_ = pybind11::none();
    SignalHandlers handlers_;
    std::atomic<bool> interrupted_{false};
    Clock::time_point last_{};
};

} // namespace quasilux
