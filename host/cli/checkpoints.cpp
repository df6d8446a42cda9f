#include "cli/checkpoints.h"

#include "learn/learned_state.h"
#include "util/messages.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace {

namespace fs = std::filesystem;

// Checkpoints take at most this share of the time, however large the film is.
constexpr double mostOfTime = 0.05;

/// Layers of the image that the sums do not hold.
std::string layersOf(const Scene& scene) {
    const PixelFormat& format = scene.sensor.pixelFormat;
    std::vector<std::string> names;
    if (format.luminance) names.emplace_back("Y");
    if (format.xyz) names.emplace_back("X, Y, Z");
    if (format.alpha) names.emplace_back("A");
    for (const AovLayer& layer : scene.aovs) names.push_back(layer.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

Checkpoint checkpointOf(const RenderOptions& options, const Scene& scene, const StopRule& stop) {
    Checkpoint checkpoint;
    checkpoint.version = QUASILUX_VERSION;
    checkpoint.kernels = kernelChecksum();
    checkpoint.wanted = options.settings(scene);
    checkpoint.freedom = text(options.freedom(scene));
    checkpoint.meter = scene.sensor.meter;
    checkpoint.stop = stop;
    checkpoint.scene = fs::path(options.scene).filename().string();
    checkpoint.isPerNanometre = scene.surroundings && scene.surroundings->isPerNanometre;
    checkpoint.view = imageViewOf(scene.sensor);
    if (checkpoint.meter == MeterKind::none) checkpoint.layersOfScene = layersOf(scene);
    return checkpoint;
}

double CheckpointKeeper::secondsToNext() const {
    if (options_.checkpoint.empty()) return INFINITY;
    if (!wasTried_) return 0;
    const double since = std::chrono::duration<double>(Clock::now() - last_).count();
    return std::max(options_.every, cost_ / mostOfTime) - since;
}

Checkpoint CheckpointKeeper::describe(const AutoRender& soFar, const PassesSoFar& passes, double seconds) const {
    Checkpoint now = base_;
    now.settings = soFar.settings;
    now.search = soFar.search;
    now.sceneChecksums = passes.report.checksums;
    now.photonsPerPass = passes.report.photonsPerPass;
    now.width = passes.film.width;
    now.height = passes.film.height;
    now.film = passes.film.layout;
    now.counters = passes.counters;
    now.seconds = seconds;
    if (now.counters.passes > 0) now.passes = {{now.stop.firstPass, passes.nextPass}};
    now.device = device_.info();
    now.timings = passes.timings();
    return now;
}

void CheckpointKeeper::afterPass(const AutoRender& soFar, const Renderer& renderer, double seconds, bool isLast) {
    if (options_.checkpoint.empty()) return;
    const auto save = [&](StateSink& sink) {
        saveLearned(sink, *renderer.learned());
        renderer.saveState(sink);
    };
    afterPasses(soFar,
                {renderer.report(), renderer.counters(), renderer.filmShape(), renderer.nextPass(),
                 [&] { return device_.timings(); }, save},
                seconds, isLast);
}

void CheckpointKeeper::afterPasses(const AutoRender& soFar, const PassesSoFar& passes, double seconds, bool isLast) {
    if (options_.checkpoint.empty()) return;
    if (soFar.search.interrupted) { // a render that went on from its settings would never search
        if (isLast)                 // quietly, too: a script that asked for a checkpoint would go on from none
            printWarning("no checkpoint is written: the render was interrupted before its settings were chosen");
        return;
    }
    const bool isNew = !wasTried_ || !failure_.empty() || writtenPass_ != passes.nextPass;
    if (!(isLast ? isNew : secondsToNext() <= 0)) return;
    const auto start = Clock::now();
    const auto why =
        failureOf([&] { writeCheckpoint(options_.checkpoint, describe(soFar, passes, seconds), passes.save); });
    if (why && failure_.empty()) warn_("no checkpoint could be written, the render goes on: " + *why);
    failure_ = why.value_or("");
    wasTried_ = true;
    writtenPass_ = passes.nextPass;
    last_ = Clock::now();
    cost_ = std::chrono::duration<double>(last_ - start).count();
}

void CheckpointKeeper::missed(const std::string& why) {
    if (!options_.checkpoint.empty()) failure_ = why;
}

Resumed::Resumed(const std::string& path, const Checkpoint& wanted)
    : reader_(path), checkpoint_(quasilux::checkpointOf(reader_)) {
    const auto difference = differenceOfWanted(checkpoint_, wanted);
    if (!difference.empty())
        throw InputError(fmt::format("--resume {}: made with other settings: {}; give the scene and the options that "
                                     "it was begun with",
                                     path, difference));
    if (checkpoint_.passes.size() > 1)
        throw InputError(fmt::format("--resume {}: it has passes {}, expected passes that follow each other without a "
                                     "gap",
                                     path, text(checkpoint_.passes)));
}

StopRule Resumed::stopRule(const StopRule& said) const {
    const unsigned begun = checkpoint_.stop.firstPass;
    StopRule stop = said;
    if (!said.seconds && !said.passes && !said.relativeError) stop = checkpoint_.stop;
    if (said.passes && said.firstPass != begun)
        throw InputError(fmt::format("--resume {}: it begins with pass {}, but --passes asks to begin with pass {}: "
                                     "expected --passes {}:END",
                                     reader_.path(), begun, said.firstPass, begun));
    stop.firstPass = begun;
    return stop;
}

std::unique_ptr<Renderer> Resumed::renderer(Device& device, const Scene& scene) const {
    auto learned = std::make_shared<const LearnedScene>(restoreLearned(reader_));
    std::unique_ptr<Renderer> renderer;
    try {
        renderer = std::make_unique<Renderer>(device, scene, checkpoint_.settings, learned, checkpoint_.sceneChecksums);
    } catch (const InputError& error) {
        throw InputError(fmt::format("--resume {}: {}", reader_.path(), error.what()));
    }
    const auto& passes = checkpoint_.passes;
    renderer->restoreState(reader_, checkpoint_.counters, passes.empty() ? 0 : passes.back().end);
    device.resetTimings(checkpoint_.timings);
    return renderer;
}

std::string checkpointThatIsThere(const std::string& path) {
    const std::string previous = previousCheckpoint(path);
    std::error_code status;
    return !fs::exists(path, status) && fs::exists(previous, status) ? previous : path;
}

void checkCheckpointOptions(const RenderOptions& options) {
    if (options.checkpoint.empty()) return;
    checkOutputPath(options.checkpoint, "--checkpoint", checkpointExtension);
    std::error_code status;
    const std::string there = checkpointThatIsThere(options.checkpoint);
    const bool isResumed =
        !options.resume.empty() && fs::equivalent(there, checkpointThatIsThere(options.resume), status);
    if (fs::exists(there, status) && !isResumed)
        throw InputError(fmt::format("--checkpoint {}: there is a checkpoint already: go on from it by --resume {}, or "
                                     "remove {} first",
                                     options.checkpoint, options.checkpoint, there));
}

} // namespace quasilux
