// `quasilux photometry`: what a luminaire's file says, as figures and as a polar curve.
#pragma once

#include "cli/photometry_options.h"

namespace quasilux {

/// Prints the figures on stdout. Throws InputError.
int photometryCommand(const PhotometryOptions& options);

} // namespace quasilux
