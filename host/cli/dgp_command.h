// `quasilux dgp`: daylight glare probability of an image.
#pragma once

#include "cli/dgp_options.h"

namespace quasilux {

/// Throws InputError.
int dgpCommand(const DgpOptions& options);

} // namespace quasilux
