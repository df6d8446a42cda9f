// The tree of a scene: over what lies in the world and, where there are instances, over these, behind which lies a tree
// for each group (docs/method/traversal.md).
#pragma once

#include "prepare/borders.h"
#include "prepare/bvh.h"

namespace quasilux {

struct SceneTree {
    Bvh bvh;
    std::vector<unsigned> groupRoots;           ///< by Scene::groups
    unsigned instanceRoot = QL_NONE;            ///< node; QL_NONE: there are no instances
    unsigned firstGroup = 0, firstInstance = 0; ///< places of their records behind the blocks (shared::Instance)
};
SceneTree buildSceneTree(const Scene& scene);

/// Writes the records of groups and instances in the places that buildSceneTree() has written into the tree. The groups
/// lack their roots.
void appendInstances(const Scene& scene, const SurfaceBorders& borders, std::vector<shared::ShapeGroup> groups,
                     SceneTree& tree);

} // namespace quasilux
