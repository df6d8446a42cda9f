// Curvature of patches: the shape operator of each triangle from the angles at its edges.
#include "prepare/border_patches.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace quasilux {
namespace {

/// Orthonormal directions in a triangle's plane.
struct PlaneFrame {
    glm::dvec3 u, v;
};

PlaneFrame planeFrame(const SurfaceTriangle& triangle, const Surface& surface) {
    const glm::dvec3 u = glm::normalize(surface.vertices[triangle.corner[1]] - surface.vertices[triangle.corner[0]]);
    return {u, glm::cross(triangle.normal, u)};
}

/// Symmetric 2 x 2 matrix in the triangle's frame.
struct ShapeOperator {
    double uu = 0, uv = 0, vv = 0;

    double largestPrincipalCurvature() const {
        const double mean = 0.5 * (uu + vv), spread = std::hypot(0.5 * (uu - vv), uv);
        return std::abs(mean) + spread;
    }
};

/// Angle between the faces at an edge, positive where convex; 0 if rounding of the vertices may have made it.
double signedAngle(const InteriorEdge& edge, double length, const Surface& surface) {
    const SurfaceTriangle &a = surface.triangles[edge.triangleA], &b = surface.triangles[edge.triangleB];
    const double angle = dihedralAngle(a, b);
    const double heightA = 2 * a.area / length, heightB = 2 * b.area / length;
    if (angle <= std::max(a.rounding, b.rounding) * (1 / heightA + 1 / heightB)) return 0;
    return glm::dot(a.normal, centroid(b, surface) - centroid(a, surface)) < 0 ? angle : -angle;
}

/// Half of each edge's bend belongs to either triangle: S = 1/A sum over edges of (angle length / 2) m m^T, where m is
/// the direction across the edge. After Cohen-Steiner and Morvan, "Restricted Delaunay triangulations and normal cycle"
/// (2003), section 2.4; exact in the limit for regular meshes of spheres and cylinders, however they are split.
std::vector<ShapeOperator> shapeOperators(const Surface& surface, const std::vector<InteriorEdge>& interior) {
    std::vector<ShapeOperator> operators(surface.triangles.size());
    for (const InteriorEdge& edge : interior) {
        const glm::dvec3 along = surface.vertices[edge.cornerB] - surface.vertices[edge.cornerA];
        const double length = glm::length(along), angle = signedAngle(edge, length, surface);
        if (angle == 0) continue;
        for (const unsigned index : {edge.triangleA, edge.triangleB}) {
            const SurfaceTriangle& triangle = surface.triangles[index];
            const PlaneFrame frame = planeFrame(triangle, surface);
            const glm::dvec3 across = glm::cross(triangle.normal, along / length);
            const double u = glm::dot(across, frame.u), v = glm::dot(across, frame.v);
            const double bend = 0.5 * angle * length / triangle.area;
            operators[index].uu += bend * u * u;
            operators[index].uv += bend * u * v;
            operators[index].vv += bend * v * v;
        }
    }
    return operators;
}

struct CurvedArea {
    unsigned part;
    double curvature, area;
};

/// Entries of one part, by rising curvature: the value that `share` of the area does not exceed.
double areaQuantile(std::span<const CurvedArea> entries, double share) {
    double total = 0, sum = 0;
    for (const CurvedArea& entry : entries) total += entry.area;
    for (const CurvedArea& entry : entries)
        if ((sum += entry.area) >= share * total) return entry.curvature;
    return entries.back().curvature;
}

} // namespace

glm::dvec3 centroid(const SurfaceTriangle& triangle, const Surface& surface) {
    return (surface.vertices[triangle.corner[0]] + surface.vertices[triangle.corner[1]] +
            surface.vertices[triangle.corner[2]]) /
           3.0;
}

std::vector<double> triangleCurvatures(const Surface& surface, const std::vector<InteriorEdge>& interior) {
    std::vector<double> curvatures;
    curvatures.reserve(surface.triangles.size());
    for (const ShapeOperator& shape : shapeOperators(surface, interior))
        curvatures.push_back(shape.largestPrincipalCurvature());
    return curvatures;
}

std::vector<double> curvatureOfParts(const Surface& surface, const std::vector<double>& curvature,
                                     const std::vector<unsigned>& partOf, size_t count) {
    std::vector<CurvedArea> areas;
    for (size_t i = 0; i < surface.triangles.size(); ++i)
        if (surface.triangles[i].kind == SurfaceTriangle::Kind::regular)
            areas.push_back({partOf[i], curvature[i], surface.triangles[i].area});
    std::stable_sort(areas.begin(), areas.end(), [](const CurvedArea& a, const CurvedArea& b) {
        return a.part != b.part ? a.part < b.part : a.curvature < b.curvature;
    });
    std::vector<double> result(count, 0.0);
    for (size_t first = 0, last = 0; first < areas.size(); first = last) {
        while (last < areas.size() && areas[last].part == areas[first].part) ++last;
        result[areas[first].part] = areaQuantile({areas.data() + first, last - first}, 0.9);
    }
    return result;
}

} // namespace quasilux
