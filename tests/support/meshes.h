// Procedural meshes for the tests of the tree and its traversal.
#pragma once

#include "prepare/bvh.h"

#include <vector>

namespace quasilux {

/// Box of five walls at -1 and 1, open at z = 1, with two boxes turned about y and a lamp below the ceiling: 36
/// triangles.
std::vector<BvhPrimitive> cornellBoxPrimitives();

/// Sphere of radius about 1 with bumps, 2 * rings * segments triangles (less the two degenerate rows at the poles).
std::vector<BvhPrimitive> bumpySpherePrimitives(unsigned rings, unsigned segments);

/// Random triangles in [-1, 1]^3: some plain, and, in equal shares, points, collinear ones, slivers (width 1e-4) and
/// exact duplicates of earlier ones.
std::vector<BvhPrimitive> awkwardPrimitives(unsigned count, unsigned seed);

/// Spheres of radius 0.01 to 0.3 in [-1, 1]^3.
std::vector<BvhPrimitive> randomSpheres(unsigned count, unsigned seed);

/// The primitives moved by `offset`, in single precision.
std::vector<BvhPrimitive> moved(std::vector<BvhPrimitive> primitives, const glm::vec3& offset);

} // namespace quasilux
