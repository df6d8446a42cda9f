#include "auto/auto_render.h"

#include "util/error.h"
#include "util/stopwatch.h"

namespace quasilux {

namespace {

// The clock of `--time` runs since learning, which took so many `learnSeconds`, began.
SearchWorld worldOf(Device& device, const Scene& scene, const KnownScene& known, double learnSeconds,
                    const std::function<void(const Progress&)>& onProgress, const std::atomic<bool>& interrupted) {
    SearchWorld world;
    world.open = [&device, &scene, known](const RenderSettings& settings) -> std::unique_ptr<Pilot> {
        return std::make_unique<RendererPilot>(device, std::make_unique<Renderer>(device, scene, settings, known),
                                               settings.cameraPaths, !scene.media.empty());
    };
    world.clock = [learnSeconds, watch = Stopwatch()] { return learnSeconds + watch.seconds(); };
    world.onPass = [&onProgress](unsigned passes) {
        Progress progress;
        progress.phase = "pilot passes";
        progress.passes = passes;
        if (onProgress) onProgress(progress);
    };
    world.interrupted = &interrupted;
    return world;
}

// Some of the device's memory is for others, and buffers grow with what is stored.
size_t pilotsInMemory(Device& device, const Renderer& renderer) {
    const uint64_t each = sumOf(renderer.report().bufferBytes);
    return device.info().globalMemory / 4 / std::max<uint64_t>(1, each);
}

// What could be opened among other pilots can be opened alone, or else the render is that of the settings where the
// search began.
std::unique_ptr<Renderer> openChosen(Device& device, const Scene& scene, const RenderSettings& first,
                                     const KnownScene& known, AutoRender& result) {
    std::unique_ptr<Renderer> renderer;
    const auto why = failureOf([&] { renderer = std::make_unique<Renderer>(device, scene, result.settings, known); });
    if (!why) return renderer;
    result.search.rows[result.search.chosen].outcome = failedOutcome + *why;
    result.search.rows[0].outcome = "chosen";
    result.search.chosen = 0;
    result.settings = first;
    return std::make_unique<Renderer>(device, scene, first, known);
}

// The image is there already: what this costs must not lose it.
void countGathered(Renderer& renderer, AutoRender& result) {
    try {
        result.gathered = renderer.countGathered();
    } catch (const InputError&) { // no memory is left for it: not counted
    } catch (...) {
        result.failure = std::current_exception();
    }
}

RenderOutcome renderAlone(const ChosenRender& chosen, const AfterChosenPass& afterPass) {
    AfterPass after;
    if (afterPass)
        after = [&](const Renderer& now, double elapsed, bool isLast) {
            afterPass(chosen.soFar, now, elapsed, isLast);
        };
    return renderAsFarAsItGoes(*chosen.renderer, chosen.stop, chosen.onProgress, chosen.interrupted, {chosen.seconds},
                               after);
}

void renderPasses(Device& device, std::shared_ptr<Renderer> renderer, double seconds, const StopRule& stop,
                  const std::function<void(const Progress&)>& onProgress, const std::atomic<bool>& interrupted,
                  const AfterChosenPass& afterPass, const PassRunner& run, AutoRender& result) {
    const ChosenRender chosen{result, std::move(renderer), stop, seconds, onProgress, interrupted};
    RenderOutcome outcome = run ? run(chosen) : renderAlone(chosen, afterPass);
    result.image = std::move(outcome.image);
    result.counters = outcome.counters;
    result.failure = outcome.failure;
    result.report = chosen.renderer->report();
    result.peakBufferBytes = device.peakBytes();
    if (result.settings.countGathered && !interrupted && !result.failure) countGathered(*chosen.renderer, result);
}

} // namespace

AutoRender renderAuto(Device& device, const Scene& scene, const RenderSettings& settings,
                      std::unique_ptr<Renderer> start, const Freedom& freedom, const StopRule& stop,
                      const std::function<void(const Progress&)>& onProgress,
                      const std::function<void(const SearchReport&)>& onChosen, const std::atomic<bool>& interrupted,
                      const AfterChosenPass& afterPass, const PassRunner& run) {
    AutoRender result;
    result.settings = settings;
    result.search.notSearched = whyNotSearched(scene, settings, stop);
    result.search.freedom = freedom;
    const KnownScene known = start->known();
    SearchWorld world = worldOf(device, scene, known, start->report().learned.seconds, onProgress, interrupted);
    if (freedom.any() && result.search.notSearched.empty()) {
        world.mostOpen = pilotsInMemory(device, *start);
        auto first =
            std::make_unique<RendererPilot>(device, std::move(start), settings.cameraPaths, !scene.media.empty());
        SearchResult found = Search(world, scene, freedom, stop).run(settings, std::move(first));
        result.search = found.report;
        result.settings = found.settings;
        // What pilots showed has decided which of them is the best, so their passes are no part of the image.
        start = found.start ? static_cast<RendererPilot&>(*found.start).release()
                            : openChosen(device, scene, settings, known, result);
    }
    if (onChosen) onChosen(result.search);
    renderPasses(device, std::move(start), world.clock(), stop, onProgress, interrupted, afterPass, run, result);
    return result;
}

AutoRender renderChosen(Device& device, const RenderSettings& settings, const SearchReport& search,
                        std::unique_ptr<Renderer> start, double seconds, const StopRule& stop,
                        const std::function<void(const Progress&)>& onProgress, const std::atomic<bool>& interrupted,
                        const AfterChosenPass& afterPass, const PassRunner& run) {
    AutoRender result;
    result.settings = settings;
    result.search = search;
    renderPasses(device, std::move(start), seconds, stop, onProgress, interrupted, afterPass, run, result);
    return result;
}

} // namespace quasilux
