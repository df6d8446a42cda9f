// Builds the tree: the only file that knows Embree's builder.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace quasilux {

/// A primitive in world space as the tree takes it.
struct BvhPrimitive {
    glm::vec3 v0{}, v1{}, v2{}; ///< sphere: v0 = centre, v1.x = radius
    bool isSphere = false;
    bool isNull = false; ///< shadow and photon rays pass through it
};

struct Bvh {
    std::vector<shared::BvhNode> nodes; ///< node 0 is the root
    std::vector<shared::PrimitiveBlock> blocks;
    unsigned depth = 1; ///< inner nodes on the longest way from the root to a leaf; bounds the traversal stack
};

/// 8-wide tree in the layout of kernels/shared_types.h. Degenerate triangles are kept (no ray meets them).
/// Primitive i of the list becomes index i in the lanes. Throws InputError where a coordinate is not finite or too
/// large for single precision (above 1e12), or where there are too many primitives for the 27 bits of a leaf reference.
Bvh buildBvh(const std::vector<BvhPrimitive>& primitives);

/// Compiler options that kernels/bvh.clh needs for this tree: "-DBVH_STACK_SIZE=n", n rounded up so that trees of
/// similar depth share compiled kernels.
std::string bvhOptions(const Bvh& bvh);

} // namespace quasilux
