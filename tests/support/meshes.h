// Procedural primitives for the tests of the tree and its traversal, besides those of the micro-benchmarks.
#pragma once

#include "bench/micro/scenes.h"

#include <vector>

namespace quasilux {

/// Random triangles in [-1, 1]^3: some plain, and, in equal shares, points, collinear ones, slivers (width 1e-4) and
/// exact duplicates of earlier ones.
std::vector<BvhPrimitive> awkwardPrimitives(unsigned count, unsigned seed);

/// Spheres of radius 0.01 to 0.3 in [-1, 1]^3.
std::vector<BvhPrimitive> randomSpheres(unsigned count, unsigned seed);

/// The primitives moved by `offset`, in single precision.
std::vector<BvhPrimitive> moved(std::vector<BvhPrimitive> primitives, const glm::vec3& offset);

} // namespace quasilux
