// Points just off the surface of a shape.
#pragma once

#include "scene/box.h"
#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Seven points spread over the shape's area, a millionth of its size off its surface (more where single precision is
/// coarser there): on the side of the normal, or behind it. Empty for a shape without area.
std::vector<glm::dvec3> pointsOff(const ShapeDescription& shape, bool onNormalSide);

/// About all places as far off its surface, on the side of the normal.
Box boundsOff(const ShapeDescription& shape);

} // namespace quasilux
