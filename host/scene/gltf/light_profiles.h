// EXT_lights_ies: luminaires by IES files that lie beside the glTF file, in a buffer of it, or in a data URI.
#pragma once

#include "scene/gltf/gltf_context.h"

#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace quasilux {

struct LightProfile {
    std::string filename;  ///< as <emitter type="quasilux_ies"> has it, or a name of EmbeddedParts::goniograms
    double multiplier = 1; ///< of the file's intensities
    glm::dvec3 color{1, 1, 1};
};

/// That of a node, if it has one. Throws InputError at `where` and below.
std::optional<LightProfile> lightProfileOf(GltfContext& context, const tinygltf::Node& node,
                                           const SourceLocation& where);

} // namespace quasilux
