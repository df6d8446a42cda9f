// Settings of quasilux in the extras of a glTF scene.
#pragma once

#include "scene/gltf/gltf_context.h"
#include "scene/xml/element.h"

#include <optional>

namespace quasilux {

/// `"extras": {"quasilux": {"bdd": 1, "illuminance-grid": {…}, "observer": [{…}, {…}]}}` as <?quasilux …?>. Throws
/// InputError.
std::vector<Instruction> instructionsOf(const tinygltf::Value& extras, const SourceLocation& where);

/// `"extras": {"quasilux": {"sky": {"type": "quasilux_cie_sky", "sky_type": 1}}}` as an <emitter>, zenith along the
/// file's +y and north along -z, as Blender exports its z and y. Throws InputError.
std::optional<Element> skyOf(const tinygltf::Value& extras, const std::string& id, const SourceLocation& where);

} // namespace quasilux
