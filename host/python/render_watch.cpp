#include "python/render_watch.h"

namespace quasilux {

namespace py = pybind11;

namespace {

// Another thread may hold the GIL for some milliseconds, so it is not asked for after every short pass.
constexpr std::chrono::milliseconds betweenLooks{50};

} // namespace

SignalHandlers::SignalHandlers() {
    for (size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], nullptr, &before_[k]);
}

void SignalHandlers::putBack() const {
    for (size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
}

DelayedSignals::DelayedSignals() {
    sigset_t delayed;
    sigemptyset(&delayed);
    for (const int signal : signals) sigaddset(&delayed, signal);
    pthread_sigmask(SIG_BLOCK, &delayed, &before_);
}

DelayedSignals::~DelayedSignals() {
    putBack();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

template <typename Action>
void RenderWatch::inPython(const Action& action) {
    last_ = Clock::now();
    const py::gil_scoped_acquire gil;
    if (!raised_.is_none()) return;
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        action();
    } catch (const py::error_already_set& error) {
        raised_ = error.value();
        if (error.trace()) PyException_SetTraceback(raised_.ptr(), error.trace().ptr());
        interrupted_ = true;
    }
}

void RenderWatch::look() {
    handlers_.putBack();
    inPython([] {});
}

void RenderWatch::onProgress(const Progress& progress) {
    handlers_.putBack();
    if (callback_.is_none()) {
        if (Clock::now() - last_ >= betweenLooks) look();
        return;
    }
    Progress ofImage = progress;
    if (progress.phase != "rendering") ofImage.passes = 0; // those of a search are no part of the image
    inPython([&] {
        if (callback_(ofImage).is(py::bool_(false))) interrupted_ = true;
    });
}

} // namespace quasilux
