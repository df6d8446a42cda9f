// Area of a shape.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// In squares of the scene's unit; of a mesh the sum over its triangles.
double areaOf(const ShapeDescription& shape);

} // namespace quasilux
