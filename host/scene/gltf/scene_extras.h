// Settings of quasilux in the extras of a glTF scene.
#pragma once

#include "scene/gltf/gltf_context.h"
#include "scene/xml/element.h"

namespace quasilux {

/// `"extras": {"quasilux": {"bdd": 1, "illuminance-grid": {…}, "observer": [{…}, {…}]}}` as <?quasilux …?>. Throws
/// InputError.
std::vector<Instruction> instructionsOf(const tinygltf::Value& extras, const SourceLocation& where);

} // namespace quasilux
