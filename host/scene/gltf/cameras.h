// Cameras of glTF files as sensors, and the view that is taken without one.
#pragma once

#include "scene/gltf/nodes.h"
#include "scene/xml/element.h"

namespace quasilux {

/// The sensor at the node, if it has a camera, into the scene. Returns whether it has. Throws InputError.
bool addCamera(GltfContext& context, const PlacedNode& node, Element& scene);

/// A view of a box from in front of it, above and to the right: +z is the front of what a glTF file shows, +y is up.
Element viewOf(const glm::dvec3& lower, const glm::dvec3& upper, const SourceLocation& where);

} // namespace quasilux
