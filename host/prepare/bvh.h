// Builds the tree: the only file that knows Embree's builder.
#pragma once

#include "scene/scene.h"

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
};

/// 8-wide tree in the layout of kernels/shared_types.h. Degenerate triangles are kept (no ray meets them).
Bvh buildBvh(const std::vector<BvhPrimitive>& primitives);

} // namespace quasilux
