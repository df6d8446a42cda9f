// `quasilux merge`: the image of the passes of several checkpoints.
#pragma once

#include "cli/merge_options.h"

namespace quasilux {

/// Returns the exit code. Throws InputError where checkpoints cannot be merged.
int mergeCommand(const MergeOptions& options);

} // namespace quasilux
