// `quasilux info`: what a scene needs and what was chosen for it.
#pragma once

#include "cli/options.h"

namespace quasilux {

/// Loads and prepares the scene, compiles its kernels, and prints the report on stdout. Throws InputError, DeviceError.
void infoCommand(const SceneOptions& options);

} // namespace quasilux
