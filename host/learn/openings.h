// Openings that light comes through from outside (windows, skylights), found from rays that serve the image
// (docs/learning.md).
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

/// A ray that serves the image.
struct UsefulRay {
    glm::dvec3 position{}, direction{}; ///< direction is of unit length
    double weight = 0;
};

/// A rectangle.
struct Opening {
    glm::dvec3 centre{}, axisU{1, 0, 0}, axisV{0, 1, 0}; ///< axes orthonormal
    double halfU = 0, halfV = 0;

    bool holds(const UsefulRay& ray) const;
};

/// At most `most`, the one first that tells most of the rays apart from rays spread evenly over a sphere of this `radius`.
/// The same for the same rays.
std::vector<Opening> findOpenings(std::vector<UsefulRay> rays, double radius, size_t most = 16);

} // namespace quasilux
