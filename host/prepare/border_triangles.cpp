// Triangle against triangle, after Moller, "A fast triangle-triangle intersection test" (1997), in doubles, with
// distances to the other's plane below rounding taken as zero.
#include "prepare/border_intersections.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quasilux {
namespace {

/// How the corners of a triangle lie to another's plane.
struct PlaneSides {
    double distance[3] = {};
    int zeros = 0, above = 0, below = 0;
};

bool hasCorner(const SurfaceTriangle& triangle, unsigned vertex) {
    return triangle.corner[0] == vertex || triangle.corner[1] == vertex || triangle.corner[2] == vertex;
}

PlaneSides sidesOf(const SurfaceTriangle& triangle, const SurfaceTriangle& plane, double tolerance,
                   const Surface& surface) {
    PlaneSides sides;
    for (int i = 0; i < 3; ++i) {
        const unsigned vertex = triangle.corner[i];
        const double distance = glm::dot(plane.normal, surface.vertices[vertex] - surface.vertices[plane.corner[0]]);
        if (std::abs(distance) <= tolerance || hasCorner(plane, vertex)) {
            ++sides.zeros;
            continue;
        }
        sides.distance[i] = distance;
        ++(distance > 0 ? sides.above : sides.below);
    }
    return sides;
}

/// Whether the triangle meets the plane along a line that is to be a segment.
bool meetsPlane(const SurfaceTriangle& triangle, const PlaneSides& sides) {
    if (sides.zeros == 3) return false;
    if (sides.zeros < 2) return sides.above > 0 && sides.below > 0;
    const int offPlane = sides.distance[0] != 0 ? 0 : sides.distance[1] != 0 ? 1 : 2;
    const unsigned inPlane = 1u << ((offPlane + 1) % 3); // the edge opposite the corner off the plane
    return !(triangle.borderEdges & inPlane) && (triangle.ownedEdges & inPlane);
}

/// The triangle's section with the plane. Edges run from the lesser vertex, so that neighbours get the same point.
CutSegment section(const SurfaceTriangle& triangle, const PlaneSides& sides, const Surface& surface) {
    glm::dvec3 points[2] = {};
    int count = 0;
    for (int i = 0; i < 3 && count < 2; ++i) {
        if (sides.distance[i] == 0) {
            points[count++] = surface.vertices[triangle.corner[i]];
            continue;
        }
        int from = i, to = (i + 1) % 3;
        if (sides.distance[from] * sides.distance[to] >= 0) continue;
        if (triangle.corner[from] > triangle.corner[to]) std::swap(from, to);
        const double t = sides.distance[from] / (sides.distance[from] - sides.distance[to]);
        points[count++] = glm::mix(surface.vertices[triangle.corner[from]], surface.vertices[triangle.corner[to]], t);
    }
    return {points[0], points[1]};
}

/// The overlap of two pieces of one line.
CutSegment overlap(CutSegment p, CutSegment q) {
    const glm::dvec3 alongP = p.b - p.a, alongQ = q.b - q.a;
    const glm::dvec3 along = glm::dot(alongP, alongP) >= glm::dot(alongQ, alongQ) ? alongP : alongQ;
    const auto position = [&](const glm::dvec3& point) { return glm::dot(along, point); };
    for (CutSegment* piece : {&p, &q})
        if (position(piece->a) > position(piece->b)) std::swap(piece->a, piece->b);
    const glm::dvec3 start = position(p.a) >= position(q.a) ? p.a : q.a;
    const glm::dvec3 end = position(p.b) <= position(q.b) ? p.b : q.b;
    return position(start) < position(end) ? CutSegment{start, end} : CutSegment{start, start};
}

} // namespace

std::optional<CutSegment> cutTriangles(const Surface& surface, const SurfaceTriangle& a, const SurfaceTriangle& b) {
    if (hasCorner(b, a.corner[0]) + hasCorner(b, a.corner[1]) + hasCorner(b, a.corner[2]) >= 2) return std::nullopt;
    const double tolerance = std::max(a.rounding, b.rounding);
    const PlaneSides sidesOfB = sidesOf(b, a, tolerance, surface);
    if (!meetsPlane(b, sidesOfB)) return std::nullopt;
    const PlaneSides sidesOfA = sidesOf(a, b, tolerance, surface);
    if (!meetsPlane(a, sidesOfA)) return std::nullopt;
    const CutSegment cut = overlap(section(a, sidesOfA, surface), section(b, sidesOfB, surface));
    if (glm::distance(cut.a, cut.b) <= tolerance) return std::nullopt;
    return cut;
}

} // namespace quasilux
