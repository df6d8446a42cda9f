// Finds the pairs of primitives that may cut each other and gathers their cuts.
#include "prepare/border_intersections.h"

#include "prepare/border_pairs.h"
#include "prepare/coplanar_overlap.h"
#include "prepare/pack.h"

#include <algorithm>
#include <utility>

namespace quasilux {
namespace {

/// The primitives that take part: regular triangles, then spheres.
struct Candidates {
    std::vector<const SurfaceTriangle*> triangles;
    std::vector<const SurfaceSphere*> spheres;
    std::vector<Box> boxes;
};

Candidates collectCandidates(const Surface& surface) {
    Candidates candidates;
    for (const SurfaceTriangle& triangle : surface.triangles) {
        if (triangle.kind != SurfaceTriangle::Kind::regular) continue;
        Box box;
        for (int i = 0; i < 3; ++i) box.add(surface.vertices[triangle.corner[i]]);
        candidates.triangles.push_back(&triangle);
        candidates.boxes.push_back({box.lower - triangle.rounding, box.upper + triangle.rounding});
    }
    for (const SurfaceSphere& sphere : surface.spheres) {
        candidates.spheres.push_back(&sphere);
        candidates.boxes.push_back({sphere.center - sphere.radius, sphere.center + sphere.radius});
    }
    return candidates;
}

bool shareCorner(const SurfaceTriangle& a, const SurfaceTriangle& b) {
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (a.corner[i] == b.corner[j]) return true;
    return false;
}

/// Of several the one whose primitives come first.
void noteOverlap(const std::optional<glm::dvec3>& place, unsigned a, unsigned b, SurfaceBorders& borders) {
    if (!place) return;
    const auto [first, second] = std::minmax(a, b);
    auto& noted = borders.overlap;
    if (!noted || std::pair(first, second) < std::pair(noted->first, noted->second)) noted = {first, second, *place};
}

} // namespace

void intersectSurfaces(const Surface& surface, SurfaceBorders& borders) {
    const std::vector<unsigned>& patchOfPrimitive = borders.patchOfPrimitive;
    const Candidates candidates = collectCandidates(surface);
    const auto triangleCount = unsigned(candidates.triangles.size());
    std::vector<CutSegment> cuts;
    forEachOverlappingPair(candidates.boxes, [&](unsigned i, unsigned j) {
        cuts.clear();
        unsigned primitiveA, primitiveB;
        if (j < triangleCount) {
            const SurfaceTriangle &a = *candidates.triangles[i], &b = *candidates.triangles[j];
            primitiveA = a.primitive;
            primitiveB = b.primitive;
            if (patchOfPrimitive[primitiveA] == patchOfPrimitive[primitiveB] && shareCorner(a, b)) return;
            noteOverlap(coplanarOverlap(surface, a, b), primitiveA, primitiveB, borders);
            if (const std::optional<CutSegment> cut = cutTriangles(surface, a, b)) cuts.push_back(*cut);
        } else if (i < triangleCount) {
            const SurfaceSphere& sphere = *candidates.spheres[j - triangleCount];
            primitiveA = candidates.triangles[i]->primitive;
            primitiveB = sphere.primitive;
            cutTriangleSphere(surface, *candidates.triangles[i], sphere, cuts);
        } else {
            const SurfaceSphere &a = *candidates.spheres[i - triangleCount],
                                &b = *candidates.spheres[j - triangleCount];
            primitiveA = a.primitive;
            primitiveB = b.primitive;
            cutSpheres(a, b, cuts);
        }
        for (const CutSegment& cut : cuts)
            borders.segments.push_back(
                {pack(cut.a), pack(cut.b), patchOfPrimitive[primitiveA], patchOfPrimitive[primitiveB]});
    });
}

} // namespace quasilux
