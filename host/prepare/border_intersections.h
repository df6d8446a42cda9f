// Where surfaces pass through each other: the curves of intersection as segments.
#pragma once

#include "prepare/border_surface.h"
#include "prepare/borders.h"
#include "scene/box.h"

#include <optional>
#include <utility>
#include <vector>

namespace quasilux {

struct CutSegment {
    glm::dvec3 a, b;
};

/// The segment along which two regular triangles pass through each other. None where they only touch at a point, lie
/// in one plane, share an edge, or meet along an edge that is a border already. Along an edge inside a patch only the
/// triangle that owns the edge yields the segment, so that a surface cut along a row of its edges is cut once.
std::optional<CutSegment> cutTriangles(const Surface& surface, const SurfaceTriangle& a, const SurfaceTriangle& b);

/// Appends the arcs of the circle in which the sphere cuts the triangle, as chords, 128 to the full turn.
void cutTriangleSphere(const Surface& surface, const SurfaceTriangle& triangle, const SurfaceSphere& sphere,
                       std::vector<CutSegment>& cuts);

/// Appends the circle in which two spheres cut each other, as 128 chords.
void cutSpheres(const SurfaceSphere& a, const SurfaceSphere& b, std::vector<CutSegment>& cuts);

/// The primitives of a surface that may cut others: regular triangles, then spheres; by index as in `boxes`.
struct CutCandidates {
    std::vector<const SurfaceTriangle*> triangles;
    std::vector<const SurfaceSphere*> spheres;
    std::vector<Box> boxes;
};
CutCandidates collectCandidates(const Surface& surface);
/// Appends the cuts of candidate i and candidate j > i, of one surface, that are not neighbours. Returns their
/// primitives.
std::pair<unsigned, unsigned> cutPair(const Surface& surface, const CutCandidates& candidates, unsigned i, unsigned j,
                                      std::vector<CutSegment>& cuts);

/// Appends all intersections in the scene, with the patches that meet there (neighbours in one patch are not tested),
/// to borders.segments, and notes sheets that overlap within a plane.
void intersectSurfaces(const Surface& surface, SurfaceBorders& borders);

} // namespace quasilux
