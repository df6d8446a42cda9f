// Passes of `quasilux render` that several devices, and ranks of an MPI job with theirs, share.
#pragma once

#include "cli/checkpoints.h"
#include "device/device_choice.h"
#include "share/shared_render.h"

namespace quasilux {

/// Of this process; the first one has learned and searched.
struct SharedDevices {
    std::shared_ptr<Device> first;
    std::vector<DeviceChoice> choices; ///< that of the first one first
    std::shared_ptr<const Scene> scene;
};

/// What --device names; of a job's rank those of its share.
std::vector<DeviceChoice> ownDevices(const RenderOptions& options);
std::shared_ptr<Device> openDevice(const RenderOptions& options, const DeviceChoice& choice);

class PassSharing {
public:
    PassSharing(const RenderOptions& options, const SharedDevices& devices, CheckpointKeeper& keeper,
                WarnAmidPasses warn)
        : options_(options), devices_(devices), keeper_(keeper), warn_(std::move(warn)) {}

    RenderOutcome run(const ChosenRender& chosen);
    /// After run(): who has rendered what.
    void describe(AutoRender& render) const;

private:
    std::unique_ptr<PassWorkers> workers(const ChosenRender& chosen) const;
    SharedHooks hooks(const ChosenRender& chosen);
    void keep(const ChosenRender& chosen, const SharedPasses& soFar, double seconds, bool isLast);

    const RenderOptions& options_;
    const SharedDevices& devices_;
    CheckpointKeeper& keeper_;
    WarnAmidPasses warn_;
    SceneReport report_; ///< from before the first device's thread takes its renderer
    std::vector<WorkerRecord> records_;
    std::map<std::string, KernelTiming> timings_;
};

/// Of a rank that is not the first: its devices render what rank 0 asks for, until the job is over. What fails is said
/// by rank 0.
void assistJob(const RenderOptions& options);

/// One of the devices that have not failed, for what follows the passes; the first one where all have.
std::shared_ptr<Device> livingDevice(const RenderOptions& options, const SharedDevices& devices,
                                     const AutoRender& render);

} // namespace quasilux
