// `<?quasilux illuminance-grid …?>` directly in the scene.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

namespace quasilux {

inline constexpr std::string_view illuminanceGridKind = "illuminance-grid";

/// The grid after the scene's `others`. Throws InputError for unknown or missing keys, edges without area, a name that
/// another one has, and more points than can be measured.
IlluminanceGrid parseIlluminanceGrid(const Instruction& instruction, const std::vector<IlluminanceGrid>& others);

} // namespace quasilux
