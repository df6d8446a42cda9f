#include "prepare/scene_geometry.h"

namespace quasilux {

SceneGeometry prepareGeometry(const Scene& scene) {
    SceneGeometry geometry{findBorders(scene), {}, buildSceneTree(scene)};
    const auto addTree = [&](const SurfaceBorders& borders) {
        geometry.borderTrees.push_back(buildBorderTree(borders.segments, borders.patchCount));
    };
    addTree(geometry.borders);
    for (const SurfaceBorders& group : geometry.borders.groups) addTree(group);
    return geometry;
}

} // namespace quasilux
