// A sphere about everything in the scene, and about the grids that are measured.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// About the centre of the scene's bounding box, as small as that allows. A little larger than rounding in single
/// precision asks for; radius 1 where the scene has no extent.
Sphere boundingSphere(const Scene& scene);

} // namespace quasilux
