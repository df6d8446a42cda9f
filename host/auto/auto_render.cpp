#include "auto/auto_render.h"

#include "auto/combination.h"

#include <chrono>

namespace quasilux {

namespace {

using Clock = std::chrono::steady_clock;

SearchWorld worldOf(Device& device, const Scene& scene, const std::function<void(const Progress&)>& onProgress,
                    const std::atomic<bool>& interrupted, RenderCounters& ofOthers) {
    SearchWorld world;
    world.open = [&device, &scene](const RenderSettings& settings) -> std::unique_ptr<Pilot> {
        return std::make_unique<RendererPilot>(device, std::make_unique<Renderer>(device, scene, settings),
                                               !scene.media.empty());
    };
    world.clock = [start = Clock::now()] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    world.onPass = [&onProgress](unsigned passes) {
        Progress progress;
        progress.phase = "pilot passes";
        progress.passes = passes;
        if (onProgress) onProgress(progress);
    };
    world.onGivenUp = [&ofOthers](const Pilot& pilot) {
        ofOthers += static_cast<const RendererPilot&>(pilot).renderer().counters();
    };
    world.interrupted = &interrupted;
    return world;
}

} // namespace

AutoRender renderAuto(Device& device, const Scene& scene, const RenderSettings& settings,
                      std::unique_ptr<Renderer> start, const Freedom& freedom, const StopRule& stop,
                      const std::function<void(const Progress&)>& onProgress,
                      const std::function<void(const SearchReport&)>& onChosen, const std::atomic<bool>& interrupted) {
    AutoRender result;
    result.settings = settings;
    RenderCounters ofOthers;
    auto first = std::make_unique<RendererPilot>(device, std::move(start), !scene.media.empty());
    result.search.notSearched = whyNotSearched(scene, settings, stop);
    result.search.freedom = freedom;
    SearchResult found{settings, nullptr, {}, {}, result.search};
    const SearchWorld world = worldOf(device, scene, onProgress, interrupted, ofOthers);
    if (freedom.any() && result.search.notSearched.empty())
        found = Search(world, scene, freedom, stop).run(settings, std::move(first));
    else
        found.best = std::move(first);
    result.search = found.report;
    result.settings = found.settings;
    if (onChosen) onChosen(result.search);

    auto& best = static_cast<RendererPilot&>(*found.best).renderer();
    std::vector<FilmImage> images = std::move(found.others);
    images.emplace_back();
    std::vector<double> seconds = found.othersSeconds;
    seconds.push_back(0);
    const RenderedBefore before{world.clock(), [&](FilmImage image) {
                                    images.back() = std::move(image);
                                    seconds.back() = best.counters().renderSeconds;
                                    result.weights = weightsByError(images, seconds);
                                    return combineImages(images, result.weights);
                                }};
    result.image = renderUntil(best, stop, onProgress, interrupted, before);
    result.report = best.report();
    result.counters = best.counters();
    result.counters += ofOthers;
    return result;
}

} // namespace quasilux
