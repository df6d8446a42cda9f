// `quasilux render`: scene in, images and statistics out.
#pragma once

#include "cli/options.h"

namespace quasilux {

/// Returns the exit code: 0 done, 130 interrupted before the first pass (nothing is written then). Throws InputError
/// (before anything is rendered), DeviceError, and std::runtime_error where a file cannot be written.
int renderCommand(const RenderOptions& options);

} // namespace quasilux
