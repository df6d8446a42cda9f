// `<?quasilux observer …?>` directly in the scene.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

namespace quasilux {

inline constexpr std::string_view observerKind = "observer";

/// The observer after `before` others. Throws InputError for unknown or missing keys, and directions that are none.
Observer parseObserver(const Instruction& instruction, size_t before);

/// A square across the line of sight at the eye, for a meter.
IlluminanceGrid eyeGrid(const Observer& observer);

} // namespace quasilux
