// Sets of rays for the tests of traversal.
#pragma once

#include "support/traversal_oracle.h"

namespace quasilux {

using Rays = std::vector<TestRay>;

/// Origins in a cube of half side `extent` about `center`, directions all around of length 0.1 to 10; a half of the
/// rays ends nowhere, a half begins at 0.
Rays randomRays(size_t count, unsigned seed, float extent, const glm::vec3& center = {});

/// Along the axes, both ways, with 0 and -0 as the other components, from a lattice that touches planes of the Cornell
/// box.
Rays axisParallelRays();

/// Rays in random directions that begin at the hits of other rays, tMin = 0.
Rays surfaceRays(const Rays& before, const std::vector<TestHit>& hits, unsigned seed);

} // namespace quasilux
