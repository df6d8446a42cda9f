#include "prepare/coplanar_overlap.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace quasilux {

namespace {

constexpr double smallestShare = 1e-6; // of the area of the smaller triangle

using Polygon = std::vector<glm::dvec3>;

/// The part of `polygon` on the inner side of an edge through `from` (Sutherland & Hodgman 1974).
Polygon clip(const Polygon& polygon, const glm::dvec3& from, const glm::dvec3& inwards) {
    Polygon inner;
    for (size_t k = 0; k < polygon.size(); ++k) {
        const glm::dvec3 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double depthP = glm::dot(p - from, inwards), depthQ = glm::dot(q - from, inwards);
        if (depthP >= 0) inner.push_back(p);
        if ((depthP < 0) != (depthQ < 0)) inner.push_back(glm::mix(p, q, depthP / (depthP - depthQ)));
    }
    return inner;
}

double area(const Polygon& polygon, const glm::dvec3& normal) {
    glm::dvec3 sum(0);
    for (size_t k = 1; k + 1 < polygon.size(); ++k)
        sum += glm::cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
    return 0.5 * glm::dot(sum, normal);
}

bool inOnePlane(const Surface& surface, const SurfaceTriangle& a, const SurfaceTriangle& b) {
    if (!(glm::dot(a.normal, b.normal) > 0)) return false;
    const double allowed = a.rounding + b.rounding;
    const glm::dvec3 pa = surface.vertices[a.corner[0]], pb = surface.vertices[b.corner[0]];
    for (int i = 0; i < 3; ++i)
        if (std::abs(glm::dot(surface.vertices[b.corner[i]] - pa, a.normal)) > allowed ||
            std::abs(glm::dot(surface.vertices[a.corner[i]] - pb, b.normal)) > allowed)
            return false;
    return true;
}

} // namespace

std::optional<glm::dvec3> coplanarOverlap(const Surface& surface, const SurfaceTriangle& a, const SurfaceTriangle& b) {
    if (!inOnePlane(surface, a, b)) return std::nullopt;
    Polygon common;
    for (int i = 0; i < 3; ++i) common.push_back(surface.vertices[a.corner[i]]);
    for (int i = 0; i < 3 && common.size() > 2; ++i) {
        const glm::dvec3 from = surface.vertices[b.corner[i]], to = surface.vertices[b.corner[(i + 1) % 3]];
        common = clip(common, from, glm::cross(b.normal, to - from));
    }
    if (common.size() < 3 || !(area(common, a.normal) > smallestShare * std::min(a.area, b.area))) return std::nullopt;
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : common) middle += p / double(common.size());
    return middle;
}

} // namespace quasilux
