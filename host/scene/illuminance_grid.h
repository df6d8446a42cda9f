// `<?quasilux illuminance-grid …?>` directly in the scene.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

namespace quasilux {

inline constexpr std::string_view illuminanceGridKind = "illuminance-grid";

/// Throws InputError for unknown or missing keys, edges without area, and more points than can be measured.
IlluminanceGrid parseIlluminanceGrid(const Instruction& instruction);

} // namespace quasilux
