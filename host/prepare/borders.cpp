// Finds patches and borders: weld, join, cut, measure.
#include "prepare/borders.h"

#include "prepare/border_intersections.h"
#include "prepare/border_patches.h"

namespace quasilux {

SurfaceBorders findBorders(const Scene& scene, double creaseAngle) {
    SurfaceBorders borders;
    Surface surface = collectSurface(scene);
    const std::vector<InteriorEdge> interior = joinPatches(scene, creaseAngle, surface, borders);
    borders.patchCurvature = patchCurvatures(surface, interior, borders);
    intersectSurfaces(surface, borders);
    return borders;
}

} // namespace quasilux
