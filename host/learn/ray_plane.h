// The plane in which rays from outside are told apart best: that of the opening they come through (docs/learning.md).
#pragma once

#include "learned_types.h"

#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

/// A ray that serves the image.
struct UsefulRay {
    glm::dvec3 position{}, direction{};
    double weight = 0;
};

struct RayPlane {
    glm::dvec3 centre{}, axisU{1, 0, 0}, axisV{0, 1, 0};
    double halfU = 1, halfV = 1; ///< half of the sides of what most rays come through
    double area() const { return 4 * halfU * halfV; }
};

/// Through the place nearest to all rays, across that normal for which they are closest together, with axes along their
/// bounds. `rays` is not empty.
RayPlane fitRayPlane(const std::vector<UsefulRay>& rays);

} // namespace quasilux
