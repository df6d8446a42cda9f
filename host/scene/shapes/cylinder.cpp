// <shape type="cylinder">: without caps, from p0 to p1, normals outwards.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

#include <cmath>
#include <numbers>

namespace quasilux {

void readCylinder(Properties& properties, ShapeDescription& shape) {
    constexpr unsigned sectors = roundSectors;
    const glm::dvec3 from = properties.vector("p0", {0, 0, 0}), to = properties.vector("p1", {0, 0, 1});
    const double radius = properties.numberAbove("radius", 1, 0, true);
    if (!(glm::length(to - from) > 0))
        throw InputError(properties.where("p1"), "p0 and p1 of the cylinder are the same point; set them apart.");
    const auto [s, t] = axesAcross(glm::normalize(to - from));
    MeshSource source;
    for (unsigned k = 0; k <= sectors; ++k) {
        const double angle = 2 * std::numbers::pi * k / sectors;
        const glm::dvec3 outward = std::cos(angle) * s + std::sin(angle) * t;
        source.normals.push_back(outward);
        for (unsigned end = 0; end < 2; ++end) {
            if (k < sectors)
                source.positions.push_back((end == 0 ? from : to) + radius * roundRadius(sectors) * outward);
            source.uvs.emplace_back(double(k) / sectors, end);
        }
    }
    const auto corner = [&](unsigned k, unsigned end) {
        const unsigned position = 2 * (k % sectors) + end;
        return MeshSource::Corner{position, k % sectors, 2 * k + end, position};
    };
    for (unsigned k = 0; k < sectors; ++k) {
        source.triangles.push_back({corner(k, 0), corner(k + 1, 0), corner(k + 1, 1)});
        source.triangles.push_back({corner(k, 0), corner(k + 1, 1), corner(k, 1)});
    }
    shape.mesh = fileMesh(source, properties.transform("to_world"), shape.flipNormals, false, shape.where,
                          properties.context().placement);
}

} // namespace quasilux
