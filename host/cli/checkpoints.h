// Checkpoints of `quasilux render`: written while it renders, and taken up again (docs/reference/reliability.md).
#pragma once

#include "auto/auto_render.h"
#include "cli/options.h"
#include "output/render_checkpoint.h"

#include <chrono>

namespace quasilux {

/// What a render of these options is, before anything is known of its passes.
Checkpoint checkpointOf(const RenderOptions& options, const Scene& scene, const StopRule& stop);

using WarnAmidPasses = std::function<void(const std::string& message)>;

/// How far a render has come, wherever its passes are.
struct PassesSoFar {
    const SceneReport& report;
    const RenderCounters& counters;
    Renderer::FilmShape film;
    unsigned nextPass;
    std::function<std::map<std::string, KernelTiming>()> timings;
    std::function<void(StateSink&)> save; ///< writeCheckpoint()
};

/// Writes the checkpoint of a render when it is due. A disk that is full does not end the render: a warning says
/// so, and writing is tried again when the next one is due.
class CheckpointKeeper {
public:
    /// `base`: checkpointOf(). Nothing is written where options name no file. `warn` prints what is wrong while the
    /// render goes on.
    CheckpointKeeper(const RenderOptions& options, Device& device, Checkpoint base, WarnAmidPasses warn)
        : options_(options), device_(device), base_(std::move(base)), warn_(std::move(warn)) {}

    void afterPass(const AutoRender& soFar, const Renderer& renderer, double seconds, bool isLast);
    /// The same of passes that no single renderer has.
    void afterPasses(const AutoRender& soFar, const PassesSoFar& passes, double seconds, bool isLast);
    /// The last one cannot be written.
    void missed(const std::string& why);
    /// Seconds until the next one is due, 0 and less: it is; infinity where none will be.
    double secondsToNext() const;
    /// Why the last one could not be written; empty if it was.
    const std::string& failure() const { return failure_; }

private:
    using Clock = std::chrono::steady_clock;
    Checkpoint describe(const AutoRender& soFar, const PassesSoFar& passes, double seconds) const;

    const RenderOptions& options_;
    Device& device_;
    Checkpoint base_;
    WarnAmidPasses warn_;
    std::string failure_;
    unsigned writtenPass_ = 0;
    bool wasTried_ = false;
    Clock::time_point last_{};
    double cost_ = 0; ///< seconds that the last one took
};

/// A checkpoint that a render of these options can go on from.
class Resumed {
public:
    /// Throws InputError where it is damaged or of another render.
    Resumed(const std::string& path, const Checkpoint& wanted);

    const Checkpoint& checkpoint() const { return checkpoint_; }
    /// The rule of the command line, or, where that says nothing, the one from before. Throws InputError where passes
    /// do not follow.
    StopRule stopRule(const StopRule& said) const;
    /// With all passes so far. Throws InputError where the scene has changed.
    std::unique_ptr<Renderer> renderer(Device& device, const Scene& scene) const;

private:
    CheckpointReader reader_;
    Checkpoint checkpoint_;
};

/// `path`, or the one before it where only that is there: a file system without hard links has none by the name of
/// `path` for a moment.
std::string checkpointThatIsThere(const std::string& path);

/// Throws InputError where the file of a new checkpoint would replace that of another render, or cannot be written.
void checkCheckpointOptions(const RenderOptions& options);

} // namespace quasilux
