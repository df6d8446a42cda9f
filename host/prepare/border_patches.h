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

/// Numbers the patches (`patchOfPrimitive`, `patchCount`), measures their curvature and appends the edges that bound them
/// to `segments`. Marks border and owned edges in `surface`.
void joinPatches(const Scene& scene, std::span<const ShapeDescription> shapes, double creaseAngle, Surface& surface,
                 SurfaceBorders& borders);

/// Angle between the oriented normals of two triangles, 0 to pi.
double dihedralAngle(const SurfaceTriangle& a, const SurfaceTriangle& b);

/// Mean of the corners.
glm::dvec3 centroid(const SurfaceTriangle& triangle, const Surface& surface);

/// Larger principal curvature by triangle, 1/scene unit; 0 where flat within rounding.
std::vector<double> triangleCurvatures(const Surface& surface, const std::vector<InteriorEdge>& interior);

/// The curvature that 90 % of a part's area does not exceed, of each of `count` parts; partOf: by triangle.
std::vector<double> curvatureOfParts(const Surface& surface, const std::vector<double>& curvature,
                                     const std::vector<unsigned>& partOf, size_t count);

/// By edge inside smooth parts of the surface, whether it is to be a border all the same, as it parts a flat region from
/// a narrow bend: a rounded edge of a board, the rim of a cup, a handle. A disc as wide as serves the flat regions would
/// reach round the bend to the other face; in a patch of its own a bend has a radius of its own.
std::vector<bool> edgesOfBends(const Surface& surface, const std::vector<InteriorEdge>& interior,
                               const std::vector<double>& curvature);

} // namespace quasilux
