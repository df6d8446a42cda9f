// Triangles that lie in one plane, face the same way and overlap in part: rounding decides which of them a ray meets.
#pragma once

#include "prepare/border_surface.h"

#include <optional>

namespace quasilux {

/// A point within both triangles, if they lie in one plane within rounding, face the same way, and share more area than
/// 1e-6 of the smaller one. Neighbours that touch along an edge do not; nor do triangles of the same corners, which are
/// one.
std::optional<glm::dvec3> coplanarOverlap(const Surface& surface, const SurfaceTriangle& a, const SurfaceTriangle& b);

} // namespace quasilux
