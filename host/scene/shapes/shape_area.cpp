#include "scene/shapes/shape_area.h"

#include <numbers>

namespace quasilux {

double areaOf(const ShapeDescription& shape) {
    if (shape.sphere) return 4 * std::numbers::pi * shape.sphere->radius * shape.sphere->radius;
    double area = 0;
    for (const glm::uvec3& triangle : shape.mesh.triangles) {
        const glm::dvec3 a = shape.mesh.positions[triangle.x];
        area += 0.5 * glm::length(glm::cross(glm::dvec3(shape.mesh.positions[triangle.y]) - a,
                                             glm::dvec3(shape.mesh.positions[triangle.z]) - a));
    }
    return area;
}

double areaOf(const ShapeDescription& shape, const glm::dmat3& map) {
    double area = 0;
    for (const glm::uvec3& triangle : shape.mesh.triangles) {
        const glm::dvec3 a = shape.mesh.positions[triangle.x];
        area += 0.5 * glm::length(glm::cross(map * (glm::dvec3(shape.mesh.positions[triangle.y]) - a),
                                             map * (glm::dvec3(shape.mesh.positions[triangle.z]) - a)));
    }
    return area;
}

} // namespace quasilux
