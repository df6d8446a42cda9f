// Smooth patches: triangles joined across flat edges, the other edges as border segments, the patches' curvature.
#pragma once

#include "prepare/border_surface.h"
#include "prepare/borders.h"

namespace quasilux {

/// An edge inside a patch, shared by two triangles (indices into Surface::triangles).
struct InteriorEdge {
    unsigned cornerA = 0, cornerB = 0; ///< triangleA runs from cornerA to cornerB, triangleB back
    unsigned triangleA = 0, triangleB = 0;
};

/// Numbers the patches (`patchOfPrimitive`, `patchCount`) and appends the edges that bound them to `segments`. Marks
/// border and owned edges in `surface`. Returns the edges inside patches.
std::vector<InteriorEdge> joinPatches(const Scene& scene, std::span<const ShapeDescription> shapes, double creaseAngle,
                                      Surface& surface, SurfaceBorders& borders);

/// Angle between the oriented normals of two triangles, 0 to pi.
double dihedralAngle(const SurfaceTriangle& a, const SurfaceTriangle& b);

/// Curvature by patch, 1/scene unit: 1/radius of a sphere; of a mesh the larger principal curvature that 90 % of its
/// area does not exceed; 0 where flat within rounding.
std::vector<float> patchCurvatures(const Surface& surface, const std::vector<InteriorEdge>& interior,
                                   const SurfaceBorders& borders);

} // namespace quasilux
