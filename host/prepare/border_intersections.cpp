// Finds the pairs of primitives that may cut each other and gathers their cuts.
#include "prepare/border_intersections.h"

#include "prepare/border_pairs.h"
#include "prepare/coplanar_overlap.h"
#include "prepare/pack.h"

#include <algorithm>
#include <utility>

namespace quasilux {
CutCandidates collectCandidates(const Surface& surface) {
    CutCandidates candidates;
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

std::pair<unsigned, unsigned> cutPair(const Surface& surface, const CutCandidates& candidates, unsigned i, unsigned j,
                                      std::vector<CutSegment>& cuts) {
    const auto triangleCount = unsigned(candidates.triangles.size());
    if (j < triangleCount) {
        const SurfaceTriangle &a = *candidates.triangles[i], &b = *candidates.triangles[j];
        if (const std::optional<CutSegment> cut = cutTriangles(surface, a, b)) cuts.push_back(*cut);
        return {a.primitive, b.primitive};
    }
    const SurfaceSphere& sphere = *candidates.spheres[j - triangleCount];
    if (i < triangleCount) {
        cutTriangleSphere(surface, *candidates.triangles[i], sphere, cuts);
        return {candidates.triangles[i]->primitive, sphere.primitive};
    }
    const SurfaceSphere& other = *candidates.spheres[i - triangleCount];
    cutSpheres(other, sphere, cuts);
    return {other.primitive, sphere.primitive};
}

namespace {

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
    const CutCandidates candidates = collectCandidates(surface);
    const auto triangleCount = unsigned(candidates.triangles.size());
    std::vector<CutSegment> cuts;
    forEachOverlappingPair(candidates.boxes, [&](unsigned i, unsigned j) {
        cuts.clear();
        if (j < triangleCount) {
            const SurfaceTriangle &a = *candidates.triangles[i], &b = *candidates.triangles[j];
            if (patchOfPrimitive[a.primitive] == patchOfPrimitive[b.primitive] && shareCorner(a, b)) return;
            noteOverlap(coplanarOverlap(surface, a, b), a.primitive, b.primitive, borders);
        }
        const auto [a, b] = cutPair(surface, candidates, i, j, cuts);
        for (const CutSegment& cut : cuts)
            borders.segments.push_back({pack(cut.a), pack(cut.b), patchOfPrimitive[a], patchOfPrimitive[b]});
    });
}

} // namespace quasilux
