// `quasilux compare`: two images in, their differences out.
#pragma once

#include "cli/compare_options.h"

namespace quasilux {

/// Returns the exit code: 0 within all thresholds, 1 if one is exceeded. Throws InputError, and std::runtime_error where
/// the page cannot be written.
int compareCommand(const CompareOptions& options);

} // namespace quasilux
