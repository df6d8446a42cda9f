// The commands of the program but for `render` (render_queue.h); a file each, in the order of `quasilux --help`. They
// throw InputError before anything is computed, DeviceError, and std::runtime_error where a file cannot be written.
// What is returned is the exit code.
#pragma once

#include "cli/options.h"

namespace quasilux {

/// A render that a page in the browser shows and changes (docs/guide/live-view.md). Throws InputError where the scene
/// cannot be loaded to begin with; later the page says so.
int viewCommand(const RenderOptions& options);

/// The image of the passes of several checkpoints.
int mergeCommand(const MergeOptions& options);

/// Two images in, their differences out. 0: within all thresholds; 1: one is exceeded.
int compareCommand(const CompareOptions& options);

/// What a luminaire's file says, as figures on stdout and as a polar curve.
int photometryCommand(const PhotometryOptions& options);

/// Pictures of luminance and illuminance with a scale, and isolux lines of grids.
int falseColourCommand(const FalseColourOptions& options);

/// Scene in, one page on its lighting out. Exit code as of renderScenes.
int reportCommand(const ReportOptions& options);

/// Daylight glare probability of an image.
int dgpCommand(const DgpOptions& options);

/// Renders and kernels, timed.
int benchCommand(const BenchOptions& options);

/// The OpenCL devices and their numbers on stdout, as a table or a JSON array.
void listDevicesCommand(bool json);

/// What is wrong with devices, runtimes and libraries, and what to do. 0: renders will run, also where there are
/// warnings; 1: something keeps them from it.
int doctorCommand(bool json);

/// Man pages and completions of `program` as files, into the folders below `folder` where systems look for them (as in
/// /usr/share). Throws InputError, std::system_error.
void manualCommand(CLI::App& program, const std::string& folder);

/// Loads and prepares the scene, compiles its kernels, and prints on stdout what it needs and what was chosen for it.
void infoCommand(const SceneOptions& options);

} // namespace quasilux
