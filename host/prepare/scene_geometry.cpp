#include "prepare/scene_geometry.h"

namespace quasilux {

SceneGeometry prepareGeometry(const Scene& scene) {
    SceneGeometry geometry{findBorders(scene), {}, buildSceneTree(scene)};
    const auto addTree = [&](SurfaceBorders& borders) {
        geometry.borderTrees.push_back(buildBorderTree(borders.segments, borders.patchCount));
        borders.segments = {}; // of a large mesh there are many
    };
    addTree(geometry.borders);
    for (SurfaceBorders& group : geometry.borders.groups) addTree(group);
    return geometry;
}

} // namespace quasilux
