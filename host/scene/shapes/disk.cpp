// <shape type="disk">: of radius 1 in the plane z = 0, normal +z.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

#include <cmath>
#include <numbers>

namespace quasilux {

void readDisk(Properties& properties, ShapeDescription& shape) {
    constexpr unsigned sectors = roundSectors;
    const double radius = roundRadius(sectors);
    std::vector<glm::dvec3> corners{{0, 0, 0}};
    std::vector<glm::uvec3> triangles;
    std::vector<glm::vec2> uvs; // (r, angle / 2 pi), as Mitsuba's
    for (unsigned k = 0; k < sectors; ++k) {
        const double angle = 2 * std::numbers::pi * k / sectors;
        corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        triangles.emplace_back(0, 1 + k, 1 + (k + 1) % sectors);
        const float first = float(k) / sectors, last = float(k + 1) / sectors;
        uvs.insert(uvs.end(), {{0, (first + last) / 2}, {1, first}, {1, last}});
    }
    shape.mesh = flatMesh(corners, triangles, uvs, properties.transform("to_world"), shape.flipNormals, shape.where);
}

} // namespace quasilux
