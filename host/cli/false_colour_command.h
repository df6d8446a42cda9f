// `quasilux falsecolour`: pictures of luminance and illuminance with a scale, and isolux lines of grids.
#pragma once

#include "cli/false_colour_options.h"

namespace quasilux {

/// Throws InputError, and std::runtime_error where the picture cannot be written.
int falseColourCommand(const FalseColourOptions& options);

} // namespace quasilux
