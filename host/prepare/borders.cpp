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
    const std::vector<shared::BorderSegment> cuts = intersectSurfaces(surface, borders.patchOfPrimitive);
    borders.segments.insert(borders.segments.end(), cuts.begin(), cuts.end());
    return borders;
}

} // namespace quasilux
