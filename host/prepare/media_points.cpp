// Places to ask which medium lies beside a surface.
#include "prepare/media_points.h"

#include "scene/origin.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr size_t pointCount = 7;     // odd, so that two media cannot draw
constexpr double relative = 1e-6;    // of the shape's size
constexpr double rounding = 4.8e-07; // of the coordinates: four units in the last place of single precision

double largestCoordinate(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

std::vector<glm::dvec3> pointsOffSphere(const Sphere& sphere, double side) {
    const glm::dvec3 center(sphere.center);
    const double offset = std::max(relative * sphere.radius, rounding * (largestCoordinate(center) + sphere.radius));
    std::vector<glm::dvec3> points;
    for (size_t i = 0; i < pointCount; ++i) { // a spiral from pole to pole
        const double z = 1 - (2 * static_cast<double>(i) + 1) / pointCount, phi = 2.4 * static_cast<double>(i);
        const double r = std::sqrt(1 - z * z);
        points.push_back(center +
                         (sphere.radius + side * offset) * glm::dvec3(r * std::cos(phi), r * std::sin(phi), z));
    }
    return points;
}

/// Off a mesh of this area.
double offsetAt(const glm::dvec3& place, double area) {
    return std::max(relative * std::sqrt(area), rounding * largestCoordinate(place));
}

/// Along the normal, twice the triangle's area long.
glm::dvec3 doubleArea(const Mesh& mesh, const glm::uvec3& t) {
    const glm::dvec3 a(mesh.positions[t.x]);
    return glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
}

std::vector<glm::dvec3> pointsOffMesh(const Mesh& mesh, double side) {
    std::vector<double> areaUpTo; // of triangles up to and including this one
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        area += glm::length(doubleArea(mesh, t)) / 2;
        areaUpTo.push_back(area);
    }
    std::vector<glm::dvec3> points;
    if (!(area > 0)) return points;
    for (size_t i = 0; i < pointCount; ++i) {
        const double target = area * (static_cast<double>(i) + 0.5) / pointCount;
        const auto at = std::upper_bound(areaUpTo.begin(), areaUpTo.end(), target);
        const glm::uvec3& t = mesh.triangles[static_cast<size_t>(at - areaUpTo.begin())];
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const glm::dvec3 on = 0.41 * a + 0.34 * b + 0.25 * c; // not on lines of symmetry
        points.push_back(on + side * offsetAt(on, area) * glm::normalize(doubleArea(mesh, t)));
    }
    return points;
}

} // namespace

std::vector<glm::dvec3> pointsOff(const ShapeDescription& shape, bool onNormalSide) {
    const double side = onNormalSide ? 1 : -1;
    if (shape.sphere) return pointsOffSphere(*shape.sphere, shape.flipNormals ? -side : side);
    return pointsOffMesh(shape.mesh, side);
}

Box boundsOff(const ShapeDescription& shape) {
    if (shape.sphere) return boxOf(shape);
    const Mesh& mesh = shape.mesh;
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) area += glm::length(doubleArea(mesh, t)) / 2;
    Box box;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 normal = doubleArea(mesh, t);
        if (!(glm::length(normal) > 0)) continue;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 corner(mesh.positions[t[k]]);
            box.add(corner + offsetAt(corner, area) * glm::normalize(normal));
        }
    }
    return box;
}

} // namespace quasilux
