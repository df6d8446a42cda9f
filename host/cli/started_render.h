// A render that has been prepared: from the beginning, or from where a checkpoint has it.
#pragma once

#include "cli/checkpoints.h"
#include "cli/pass_sharing.h"

namespace quasilux {

class StartedRender {
public:
    /// Throws InputError where the checkpoint is of another render.
    StartedRender(const RenderOptions& options, Device& device, const Scene& scene, const KnownScene& known = {});

    const StopRule& stop() const { return wanted_.stop; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Until the stop rule or `interrupted`; `afterPass` is called beside the keeper of checkpoints.
    AutoRender render(const std::function<void(const Progress&)>& onProgress,
                      const std::function<void(const SearchReport&)>& onChosen, const std::atomic<bool>& interrupted,
                      const AfterChosenPass& afterPass = {});
    /// To be called before render(): its passes are shared.
    void share(SharedDevices devices) { sharing_ = std::move(devices); }
    /// Those that were printed while passes were rendered.
    const std::vector<std::string>& warningsAmidPasses() const { return warningsAmidPasses_; }
    /// Why the last checkpoint could not be written; empty if it was.
    std::string checkpointFailure() const { return keeper_ ? keeper_->failure() : ""; }

private:
    void warnOfDevice(const DeviceInfo& before);
    void warnAmidPasses(const std::string& message);

    const RenderOptions& options_;
    Device& device_;
    const Scene& scene_;
    Freedom freedom_;
    Checkpoint wanted_;
    std::optional<Resumed> resumed_;
    RenderSettings settings_;
    std::unique_ptr<Renderer> renderer_;
    std::optional<CheckpointKeeper> keeper_;
    std::optional<SharedDevices> sharing_;
    std::vector<std::string> warnings_, warningsAmidPasses_;
};

} // namespace quasilux
