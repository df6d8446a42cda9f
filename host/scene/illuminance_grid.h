// `<?quasilux illuminance-grid …?>` directly in the scene.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

namespace quasilux {

/// Whether an instruction describes a grid rather than settings.
bool isIlluminanceGrid(const Instruction& instruction);

/// Throws InputError for unknown or missing keys, edges without area, and more points than can be measured.
IlluminanceGrid parseIlluminanceGrid(const Instruction& instruction);

} // namespace quasilux
