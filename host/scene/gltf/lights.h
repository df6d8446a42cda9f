// Lights of KHR_lights_punctual, and luminaires by the extras of nodes, as emitters.
#pragma once

#include "scene/gltf/nodes.h"
#include "scene/xml/element.h"

namespace quasilux {

/// The emitter at the node, if there is one, into the scene. Returns whether there is. Throws InputError.
bool addLight(GltfContext& context, const PlacedNode& node, Element& scene);

} // namespace quasilux
