#include "cli/started_render.h"

#include "auto/candidates.h"
#include "util/messages.h"

#include <fmt/format.h>

namespace quasilux {

StartedRender::StartedRender(const RenderOptions& options, Device& device, const Scene& scene, const KnownScene& known)
    : options_(options), device_(device), scene_(scene), freedom_(options.freedom(scene)),
      wanted_(checkpointOf(options, scene, options.stop)) {
    const std::string checkpoint = checkpointThatIsThere(options.resume);
    if (!options.resume.empty()) resumed_.emplace(checkpoint, wanted_);
    wanted_.stop = resumed_ ? resumed_->stopRule(options.stop) : options.stop;
    settings_ = resumed_ ? resumed_->checkpoint().settings : searchStart(wanted_.wanted, scene, freedom_, wanted_.stop);
    settings_.countGathered = !options.stats.empty();
    renderer_ =
        resumed_ ? resumed_->renderer(device, scene) : std::make_unique<Renderer>(device, scene, settings_, known);
    warnings_ = renderer_->report().warnings;
    if (checkpoint != options.resume)
        warnings_.push_back(fmt::format("--resume {}: is not there, it goes on from {}", options.resume, checkpoint));
    if (resumed_) warnOfDevice(resumed_->checkpoint().device);
}

AutoRender StartedRender::render(const std::function<void(const Progress&)>& onProgress,
                                 const std::function<void(const SearchReport&)>& onChosen,
                                 const std::atomic<bool>& interrupted, const AfterChosenPass& afterPass) {
    const auto warn = [this](const std::string& message) { warnAmidPasses(message); };
    keeper_.emplace(options_, device_, wanted_, warn);
    const auto afterEach = [&](const AutoRender& soFar, const Renderer& now, double seconds, bool isLast) {
        keeper_->afterPass(soFar, now, seconds, isLast);
        if (afterPass) afterPass(soFar, now, seconds, isLast);
    };
    std::optional<PassSharing> sharing;
    PassRunner run;
    if (sharing_) {
        settings_.countGathered = false; // by one device of its own passes
        sharing.emplace(options_, *sharing_, *keeper_, warn);
        run = [&](const ChosenRender& chosen) { return sharing->run(chosen); };
    }
    AutoRender render =
        resumed_ ? renderChosen(device_, settings_, resumed_->checkpoint().search, std::move(renderer_),
                                resumed_->checkpoint().seconds, stop(), onProgress, interrupted, afterEach, run)
                 : renderAuto(device_, scene_, settings_, std::move(renderer_), freedom_, stop(), onProgress, onChosen,
                              interrupted, afterEach, run);
    if (sharing) sharing->describe(render);
    return render;
}

void StartedRender::warnAmidPasses(const std::string& message) {
    if (!options_.quiet || options_.strict) {
        printTo(stderr, "\n"); // below the progress line
        printWarning(message);
    }
    warningsAmidPasses_.push_back(message);
}

void StartedRender::warnOfDevice(const DeviceInfo& before) {
    const DeviceInfo& now = device_.info();
    if (before.name != now.name || before.driver != now.driver)
        warnings_.push_back(
            fmt::format("the checkpoint was made on {} (driver {}), this is {} (driver {}): the image is "
                        "right, but not the same to the bit as on one of them alone",
                        before.name, before.driver, now.name, now.driver));
}

} // namespace quasilux
