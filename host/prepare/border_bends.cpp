// Narrow bends between flat regions of a smooth surface: patches of their own.
#include "prepare/border_patches.h"
#include "prepare/border_union_find.h"
#include "scene/box.h"

#include <algorithm>
#include <functional>
#include <numbers>
#include <queue>
#include <span>
#include <tuple>

namespace quasilux {
namespace {

/// A region with less of the area of its smooth part belongs to those about it.
constexpr double leastShare = 0.01;
/// Integral of the squared curvature over any sphere.
constexpr double turnOfSphere = 4 * std::numbers::pi;

/// Smooth parts, numbered by one of their triangles, and what is measured of them.
struct SmoothParts {
    std::vector<unsigned> partOf;            ///< by triangle
    std::vector<double> area, bendCurvature; ///< by part; a bend is curved more

    SmoothParts(const Surface& surface, const std::vector<InteriorEdge>& interior, const std::vector<double>& curvature)
        : partOf(surface.triangles.size()), area(surface.triangles.size(), 0.0) {
        UnionFind sets(partOf.size());
        for (const InteriorEdge& edge : interior) sets.unite(edge.triangleA, edge.triangleB);
        std::vector<Box> bounds(partOf.size());
        for (unsigned i = 0; i < partOf.size(); ++i) {
            partOf[i] = sets.find(i);
            area[partOf[i]] += surface.triangles[i].area;
            for (int k = 0; k < 3; ++k) bounds[partOf[i]].add(surface.vertices[surface.triangles[i].corner[k]]);
        }
        // A disc is at most as wide as half the radius of curvature (docs/method/density.md, "Curved patches"), or as the
        // part. What curves more tightly than such a disc does turns within it by more than a radian.
        bendCurvature = curvatureOfParts(surface, curvature, partOf, partOf.size());
        for (unsigned part = 0; part < partOf.size(); ++part)
            if (area[part] > 0) bendCurvature[part] = std::max(2 * bendCurvature[part], 2 / bounds[part].diagonal());
    }
};

/// Connected triangles that are all flat, or all within a bend.
class Regions {
public:
    Regions(const Surface& surface, const std::vector<InteriorEdge>& interior, const std::vector<double>& curvature)
        : parts_(surface, interior, curvature), sets_(surface.triangles.size()),
          isBent_(surface.triangles.size(), false), area_(surface.triangles.size(), 0.0), turn_(area_) {
        for (unsigned i = 0; i < isBent_.size(); ++i)
            isBent_[i] = curvature[i] > parts_.bendCurvature[parts_.partOf[i]];
        for (const InteriorEdge& edge : interior)
            if (isBent_[edge.triangleA] == isBent_[edge.triangleB]) sets_.unite(edge.triangleA, edge.triangleB);
        for (unsigned i = 0; i < area_.size(); ++i) {
            const double area = surface.triangles[i].area;
            area_[sets_.find(i)] += area;
            turn_[sets_.find(i)] += curvature[i] * curvature[i] * area;
        }
        findLarge(interior);
    }

    /// By triangle, the number of its region where that becomes a patch of its own; QL_NONE elsewhere, and in parts
    /// that have one such region or none.
    std::vector<unsigned> large() {
        const size_t count = area_.size();
        std::vector<unsigned> region(count, QL_NONE), firstOf(count, QL_NONE);
        std::vector<bool> hasSeveral(count, false);
        for (unsigned i = 0; i < count; ++i) {
            const unsigned own = sets_.find(i), part = parts_.partOf[i];
            if (!isLarge_[own]) continue;
            region[i] = own;
            if (firstOf[part] == QL_NONE) firstOf[part] = own;
            hasSeveral[part] = hasSeveral[part] || firstOf[part] != own;
        }
        for (unsigned i = 0; i < count; ++i)
            if (!hasSeveral[parts_.partOf[i]]) region[i] = QL_NONE;
        return region;
    }

private:
    /// Those of some area, without dents and spikes; and bends between flat ones, however narrow.
    void findLarge(const std::vector<InteriorEdge>& interior) {
        isLarge_.resize(area_.size());
        for (unsigned i = 0; i < area_.size(); ++i)
            isLarge_[i] = sets_.find(i) == i && area_[i] > 0 &&
                          area_[i] >= leastShare * parts_.area[parts_.partOf[i]] &&
                          (!isBent_[i] || turn_[i] >= turnOfSphere);
        std::vector<unsigned> beside(area_.size(), QL_NONE); // a large flat region beside a bend
        for (const InteriorEdge& edge : interior) {
            if (isBent_[edge.triangleA] == isBent_[edge.triangleB]) continue;
            const bool first = isBent_[edge.triangleA];
            const unsigned bend = sets_.find(first ? edge.triangleA : edge.triangleB),
                           flat = sets_.find(first ? edge.triangleB : edge.triangleA);
            if (!isLarge_[flat]) continue;
            if (beside[bend] != QL_NONE && beside[bend] != flat) isLarge_[bend] = true;
            beside[bend] = flat;
        }
    }

    SmoothParts parts_;
    UnionFind sets_;
    std::vector<bool> isBent_, isLarge_; ///< by triangle; by region
    std::vector<double> area_, turn_;    ///< by region; integral of the squared curvature
};

/// The triangles next to each, across edges inside smooth parts.
class Neighbours {
public:
    Neighbours(size_t count, const std::vector<InteriorEdge>& interior) : first_(count + 1, 0) {
        for (const InteriorEdge& edge : interior) ++first_[edge.triangleA + 1], ++first_[edge.triangleB + 1];
        for (size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
        neighbour_.resize(2 * interior.size());
        std::vector<unsigned> next(first_.begin(), first_.end() - 1);
        for (const InteriorEdge& edge : interior) {
            neighbour_[next[edge.triangleA]++] = edge.triangleB;
            neighbour_[next[edge.triangleB]++] = edge.triangleA;
        }
    }
    std::span<const unsigned> of(unsigned i) const {
        return {neighbour_.data() + first_[i], neighbour_.data() + first_[i + 1]};
    }

private:
    std::vector<unsigned> first_, neighbour_;
};

/// Gives each triangle that has none the region that is nearest along the surface.
void growRegions(const Surface& surface, const std::vector<InteriorEdge>& interior, std::vector<unsigned>& region) {
    const Neighbours neighbours(region.size(), interior);
    using Reached = std::tuple<double, unsigned, unsigned>; // distance, triangle, region
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
    const auto reachFrom = [&](unsigned i, double distance, bool ofRegion) {
        for (const unsigned j : neighbours.of(i)) {
            if (region[j] != QL_NONE) continue;
            const double step =
                glm::distance(centroid(surface.triangles[i], surface), centroid(surface.triangles[j], surface));
            next.emplace(ofRegion ? 0.0 : distance + step, j, region[i]); // a region's own triangles may be large
        }
    };
    for (unsigned i = 0; i < region.size(); ++i)
        if (region[i] != QL_NONE) reachFrom(i, 0, true);
    while (!next.empty()) {
        const auto [distance, triangle, nearest] = next.top();
        next.pop();
        if (region[triangle] != QL_NONE) continue;
        region[triangle] = nearest;
        reachFrom(triangle, distance, false);
    }
}

} // namespace

std::vector<bool> edgesOfBends(const Surface& surface, const std::vector<InteriorEdge>& interior,
                               const std::vector<double>& curvature) {
    std::vector<unsigned> region = Regions(surface, interior, curvature).large();
    std::vector<bool> isCut(interior.size(), false);
    if (std::all_of(region.begin(), region.end(), [](unsigned r) { return r == QL_NONE; })) return isCut;
    growRegions(surface, interior, region);
    for (size_t k = 0; k < interior.size(); ++k)
        isCut[k] = region[interior[k].triangleA] != region[interior[k].triangleB];
    return isCut;
}

} // namespace quasilux
