// Joins triangles across flat edges to patches and makes every other edge a border segment.
#include "prepare/border_patches.h"

#include "prepare/border_union_find.h"
#include "prepare/pack.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

namespace quasilux {
namespace {

/// One triangle's use of an edge between two vertices.
struct EdgeUse {
    unsigned low = 0, high = 0; ///< vertices
    unsigned triangle = 0;
    unsigned side = 0;    ///< edge from corner `side` to the next
    bool forward = false; ///< the triangle runs from `low` to `high`
};

using EdgeGroup = std::span<const EdgeUse>;

std::vector<EdgeUse> sortedEdges(const Surface& surface, SurfaceTriangle::Kind kind) {
    std::vector<EdgeUse> uses;
    for (unsigned i = 0; i < surface.triangles.size(); ++i) {
        if (surface.triangles[i].kind != kind) continue;
        const glm::uvec3 corner = surface.triangles[i].corner;
        for (unsigned side = 0; side < 3; ++side) {
            const unsigned from = corner[int(side)], to = corner[int(side + 1) % 3];
            if (from != to) uses.push_back({std::min(from, to), std::max(from, to), i, side, from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return uses;
}

std::vector<EdgeGroup> groupByEdge(const std::vector<EdgeUse>& uses) {
    std::vector<EdgeGroup> groups;
    for (size_t first = 0, last = 0; first < uses.size(); first = last) {
        while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
        groups.emplace_back(uses.data() + first, last - first);
    }
    return groups;
}

bool isSmooth(EdgeGroup edge, const Surface& surface, double creaseAngle) {
    if (edge.size() != 2 || edge[0].forward == edge[1].forward) return false;
    const SurfaceTriangle &a = surface.triangles[edge[0].triangle], &b = surface.triangles[edge[1].triangle];
    return a.storing == b.storing && dihedralAngle(a, b) < creaseAngle;
}

/// Gives each degenerate triangle the set of one neighbour, which joins no sets.
void attachDegenerate(const Surface& surface, const std::vector<EdgeGroup>& regular, UnionFind& sets) {
    const auto before = [](EdgeGroup edge, const EdgeUse& use) {
        return std::tie(edge[0].low, edge[0].high) < std::tie(use.low, use.high);
    };
    std::vector<bool> attached(surface.triangles.size(), false);
    for (const EdgeUse& use : sortedEdges(surface, SurfaceTriangle::Kind::degenerate)) {
        const auto edge = std::lower_bound(regular.begin(), regular.end(), use, before);
        if (attached[use.triangle] || edge == regular.end() || edge->front().low != use.low ||
            edge->front().high != use.high)
            continue;
        sets.unite(surface.triangles[use.triangle].primitive, surface.triangles[edge->front().triangle].primitive);
        attached[use.triangle] = true;
    }
}

/// One patch for all of an invisible shape.
void uniteInvisibleShapes(const Scene& scene, std::span<const ShapeDescription> shapes, UnionFind& sets) {
    unsigned first = 0;
    for (const ShapeDescription& shape : shapes) {
        const unsigned count = primitiveCount(shape);
        if (isInvisible(scene, shape))
            for (unsigned i = 1; i < count; ++i) sets.unite(first, first + i);
        first += count;
    }
}

void numberPatches(UnionFind& sets, SurfaceBorders& borders) {
    for (unsigned i = 0; i < borders.patchOfPrimitive.size(); ++i) {
        const unsigned root = sets.find(i); // the least of its set, so numbered already
        borders.patchOfPrimitive[i] = root == i ? borders.patchCount++ : borders.patchOfPrimitive[root];
    }
}

InteriorEdge interiorEdge(EdgeGroup edge) {
    const bool forward = edge[0].forward;
    return {edge[0].low, edge[0].high, edge[forward ? 0 : 1].triangle, edge[forward ? 1 : 0].triangle};
}

void measureCurvature(const Surface& surface, const std::vector<double>& curvature, SurfaceBorders& borders) {
    std::vector<unsigned> patchOf;
    patchOf.reserve(surface.triangles.size());
    for (const SurfaceTriangle& triangle : surface.triangles)
        patchOf.push_back(borders.patchOfPrimitive[triangle.primitive]);
    const std::vector<double> ofPatches = curvatureOfParts(surface, curvature, patchOf, borders.patchCount);
    borders.patchCurvature.assign(ofPatches.begin(), ofPatches.end());
    for (const SurfaceSphere& sphere : surface.spheres)
        borders.patchCurvature[borders.patchOfPrimitive[sphere.primitive]] =
            sphere.radius > 0 ? float(1 / sphere.radius) : 0.0f;
}

/// The segment of an edge; one for every two patches that meet there, so that each is named.
void appendSegments(EdgeGroup edge, const Surface& surface, SurfaceBorders& borders) {
    std::vector<unsigned> patches;
    for (const EdgeUse& use : edge)
        patches.push_back(borders.patchOfPrimitive[surface.triangles[use.triangle].primitive]);
    if (patches.size() > 2) {
        std::sort(patches.begin(), patches.end());
        patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
    }
    const shared::Packed3 a = pack(surface.vertices[edge[0].low]), b = pack(surface.vertices[edge[0].high]);
    for (size_t i = 0; i < patches.size(); i += 2)
        borders.segments.push_back({a, b, patches[i], i + 1 < patches.size() ? patches[i + 1] : QL_NONE});
}

} // namespace

double dihedralAngle(const SurfaceTriangle& a, const SurfaceTriangle& b) {
    return std::atan2(glm::length(glm::cross(a.normal, b.normal)), glm::dot(a.normal, b.normal));
}

void joinPatches(const Scene& scene, std::span<const ShapeDescription> shapes, double creaseAngle, Surface& surface,
                 SurfaceBorders& borders) {
    const std::vector<EdgeUse> uses = sortedEdges(surface, SurfaceTriangle::Kind::regular);
    const std::vector<EdgeGroup> edges = groupByEdge(uses);
    std::vector<EdgeGroup> smooth, bordering;
    std::vector<InteriorEdge> interior;
    for (const EdgeGroup& edge : edges) {
        surface.triangles[edge[0].triangle].ownedEdges |= uint8_t(1u << edge[0].side);
        if (isSmooth(edge, surface, creaseAngle)) {
            smooth.push_back(edge);
            interior.push_back(interiorEdge(edge));
        } else {
            bordering.push_back(edge);
        }
    }
    const std::vector<double> curvature = triangleCurvatures(surface, interior);
    const std::vector<bool> isCut = edgesOfBends(surface, interior, curvature);
    UnionFind sets(surface.primitiveCount);
    for (size_t i = 0; i < smooth.size(); ++i) {
        if (isCut[i])
            bordering.push_back(smooth[i]);
        else
            sets.unite(surface.triangles[interior[i].triangleA].primitive,
                       surface.triangles[interior[i].triangleB].primitive);
    }
    for (const EdgeGroup& edge : bordering)
        for (const EdgeUse& use : edge) surface.triangles[use.triangle].borderEdges |= uint8_t(1u << use.side);
    attachDegenerate(surface, edges, sets);
    for (const SurfaceTriangle& triangle : surface.triangles)
        if (triangle.kind == SurfaceTriangle::Kind::duplicate)
            sets.unite(triangle.primitive, surface.triangles[triangle.original].primitive);
    uniteInvisibleShapes(scene, shapes, sets);

    borders.patchOfPrimitive.resize(surface.primitiveCount);
    numberPatches(sets, borders);
    for (const EdgeGroup& edge : bordering) appendSegments(edge, surface, borders);
    measureCurvature(surface, curvature, borders);
}

} // namespace quasilux
