// `<?quasilux …?>` directly in the scene.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

namespace quasilux {

/// Throws InputError for unknown keys and values, and for a key given twice.
SceneSettings parseSceneSettings(const std::vector<Instruction>& instructions);

} // namespace quasilux
