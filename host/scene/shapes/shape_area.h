// Area of a shape.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// In squares of the scene's unit; of a mesh the sum over its triangles.
double areaOf(const ShapeDescription& shape);
/// Of a mesh under a linear map.
double areaOf(const ShapeDescription& shape, const glm::dmat3& map);

} // namespace quasilux
