// A render as its checkpoint has it: what it is, how far it has come (docs/reference/reliability.md).
#pragma once

#include "output/checkpoint_file.h"
#include "output/render_record.h"

#include <functional>
#include <utility>

namespace quasilux {

/// Passes first, first + 1, …, end - 1.
struct PassRange {
    unsigned first = 0, end = 0;
    bool operator==(const PassRange&) const = default;
};

/// All of it but the arrays.
struct Checkpoint {
    /// What makes passes those of one image.
    std::string version, kernels;  ///< of quasilux; checksum of its kernels
    RenderSettings wanted;         ///< as command line and scene have them, before anything was searched
    std::string freedom;           ///< what was left to a search
    RenderSettings settings;       ///< of the image
    SceneChecksums sceneChecksums; ///< SceneReport::checksums
    unsigned width = 0, height = 0;
    FilmLayout film;
    MeterKind meter = MeterKind::none;

    /// How far it has come.
    std::vector<PassRange> passes; ///< in order, none empty or touching another
    StopRule stop;
    double seconds = 0; ///< that the stop rule has counted
    RenderCounters counters;

    /// For people.
    std::string scene;         ///< file name
    std::string layersOfScene; ///< of the image, which the film does not hold: "A, albedo", empty where there are none
    bool isPerNanometre = false; ///< as RenderRecord has it; and
    std::optional<ImageView> view;
    unsigned photonsPerPass = 0;
    SearchReport search;
    DeviceInfo device;
    std::map<std::string, KernelTiming> timings;
};

/// Checksum of all kernels: passes of other kernels are no parts of one image.
std::string kernelChecksum();

nlohmann::json describe(const Checkpoint& checkpoint);
/// Throws InputError where it is of another version.
Checkpoint checkpointOf(const CheckpointReader& reader);

/// Whole or not at all; the one before is kept. `save` writes what was learned, film and radii. Throws
/// std::system_error, DeviceError.
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint,
                     const std::function<void(StateSink&)>& save);
void writeCheckpoint(const std::string& path, const Checkpoint& checkpoint, const Renderer& renderer);

/// Why `there`, the checkpoint, and `here` cannot be of one image: the first setting that differs. Empty: they can, as
/// far as `wanted` tells.
std::string differenceOfWanted(const Checkpoint& there, const Checkpoint& here);
/// The same of all that makes the image, once the scene has been prepared.
std::string differenceOfImage(const Checkpoint& there, const Checkpoint& here);

/// "0 to 99, 200 to 299", "none".
std::string text(const std::vector<PassRange>& passes);
/// In order, those that touch as one, none empty; they have no pass in common.
std::vector<PassRange> joined(std::vector<PassRange> ranges);

} // namespace quasilux
