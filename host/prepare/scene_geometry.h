// What follows from the shapes of a scene alone, whatever its camera, emitters and settings are: most of the time that
// flattening a large scene takes. Who flattens a scene again and again keeps it.
#pragma once

#include "prepare/border_tree.h"
#include "prepare/scene_tree.h"

namespace quasilux {

struct SceneGeometry {
    SurfaceBorders borders;              ///< without their segments, which are in the trees
    std::vector<BorderTree> borderTrees; ///< of the world, then of each group
    SceneTree tree;                      ///< before appendInstances()
};
SceneGeometry prepareGeometry(const Scene& scene);

} // namespace quasilux
