// Passes until the stop rule, with progress.
#include "render/error_estimate.h"
#include "render/stop_rule.h"
#include "util/stopwatch.h"

#include <algorithm>

namespace quasilux {

namespace {

// The image as it was last read back: what is left where the film is lost in the middle of a pass.
struct LastKnown {
    FilmImage image;
    RenderCounters counters;

    const FilmImage& note(const Renderer& renderer) {
        renderer.developOver(image);
        counters = renderer.counters();
        return image;
    }
};

void renderPasses(Renderer& renderer, const StopRule& stop, const std::function<void(const Progress&)>& onProgress,
                  const std::atomic<bool>& interrupted, const RenderedBefore& before, const AfterPass& afterPass,
                  LastKnown& known) {
    const Stopwatch watch;
    const auto elapsed = [&] { return before.seconds + watch.seconds(); };
    Progress progress;
    progress.phase = "rendering";
    double lastCheck = 0, checkCost = 0;
    if (afterPass && !interrupted) afterPass(renderer, elapsed(), false);
    for (unsigned pass = std::max(renderer.nextPass(), stop.firstPass); !interrupted; ++pass) {
        if (stop.passes && pass >= *stop.passes) break;
        if (stop.seconds && renderer.counters().passes > 0 && elapsed() >= *stop.seconds) break;
        renderer.renderPass(pass);
        progress.passes = static_cast<unsigned>(renderer.counters().passes);
        progress.seconds = elapsed();
        if (afterPass) afterPass(renderer, progress.seconds, false);
        if (progress.passes >= fewestPassesForError && isErrorDue(progress.seconds - lastCheck, checkCost)) {
            if (const ErrorEstimate error = estimateError(known.note(renderer)); error.isKnown())
                progress.relativeError = error.sum();
            lastCheck = elapsed();
            checkCost = lastCheck - progress.seconds;
        }
        const auto& counters = renderer.counters();
        progress.photonsPerSecond = static_cast<double>(counters.photonsEmitted) / counters.renderSeconds;
        progress.pathsPerSecond = static_cast<double>(counters.cameraPaths) / counters.renderSeconds;
        progress.secondsLeft = secondsLeft(stop, progress);
        if (onProgress) onProgress(progress);
        if (stop.relativeError && progress.relativeError >= 0 && progress.relativeError <= *stop.relativeError) break;
    }
}

} // namespace

RenderOutcome renderAsFarAsItGoes(Renderer& renderer, const StopRule& stopAt,
                                  const std::function<void(const Progress&)>& onProgress,
                                  const std::atomic<bool>& interrupted, const RenderedBefore& before,
                                  const AfterPass& afterPass) {
    const StopRule stop = withDefault(stopAt);
    LastKnown known;
    std::exception_ptr failure;
    const Stopwatch watch;
    try {
        renderPasses(renderer, stop, onProgress, interrupted, before, afterPass, known);
    } catch (const RenderAbandoned&) {
        throw;
    } catch (...) {
        if (renderer.counters().passes == 0) throw;
        failure = std::current_exception();
    }
    try {
        if (renderer.isFilmWhole()) {
            known.note(renderer);
            if (afterPass) afterPass(renderer, before.seconds + watch.seconds(), true);
        }
    } catch (...) {
        if (!failure) failure = std::current_exception();
    }
    if (failure && known.image.passes == 0) std::rethrow_exception(failure);
    return {std::move(known.image), known.counters, failure};
}

} // namespace quasilux
