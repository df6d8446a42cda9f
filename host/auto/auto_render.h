// A render whose open settings are chosen by pilot passes. Its image is that of the settings chosen, from pass 0 on.
#pragma once

#include "auto/search.h"
#include "render/renderer.h"
#include "render/worker_record.h"

namespace quasilux {

class Device;

struct AutoRender {
    FilmImage image;
    RenderSettings settings; ///< chosen; the seed is the user's
    SceneReport report;      ///< of the renderer chosen
    RenderCounters counters; ///< of the passes of the image
    SearchReport search;
    std::exception_ptr failure;        ///< RenderOutcome
    uint64_t peakBufferBytes = 0;      ///< of the device, until the image was done
    std::vector<WorkerRecord> workers; ///< that shared its passes; empty: one device had them all
    std::optional<std::map<std::string, KernelTiming>> timings; ///< of all these; of one device it has them itself
    std::optional<GatheredCount> gathered; ///< by a pass that follows, where RenderSettings::countGathered asks for it
};

/// AfterPass; `soFar` has the settings and the search.
using AfterChosenPass =
    std::function<void(const AutoRender& soFar, const Renderer& renderer, double seconds, bool isLast)>;

/// What a render goes on with, once its settings are chosen.
struct ChosenRender {
    const AutoRender& soFar; ///< settings and search
    std::shared_ptr<Renderer> renderer;
    StopRule stop;
    double seconds; ///< that the stop rule has counted
    const std::function<void(const Progress&)>& onProgress;
    const std::atomic<bool>& interrupted;
};
/// Renders its passes; empty: renderAsFarAsItGoes().
using PassRunner = std::function<RenderOutcome(const ChosenRender& chosen)>;

/// `start` was made for `settings` and has no passes yet. `onChosen` is called once, before the passes that follow.
AutoRender renderAuto(Device& device, const Scene& scene, const RenderSettings& settings,
                      std::unique_ptr<Renderer> start, const Freedom& freedom, const StopRule& stop,
                      const std::function<void(const Progress&)>& onProgress,
                      const std::function<void(const SearchReport&)>& onChosen, const std::atomic<bool>& interrupted,
                      const AfterChosenPass& afterPass = {}, const PassRunner& run = {});

/// The passes that follow of a render whose settings were chosen earlier, by `search`; `start` has the passes until
/// then, of `seconds`.
AutoRender renderChosen(Device& device, const RenderSettings& settings, const SearchReport& search,
                        std::unique_ptr<Renderer> start, double seconds, const StopRule& stop,
                        const std::function<void(const Progress&)>& onProgress, const std::atomic<bool>& interrupted,
                        const AfterChosenPass& afterPass = {}, const PassRunner& run = {});

} // namespace quasilux
