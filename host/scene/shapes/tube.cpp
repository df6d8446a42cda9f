#include "scene/shapes/tube.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

/// A vector across `axis` that is turned as little as can be from `before`.
glm::dvec3 carriedOn(const glm::dvec3& before, const glm::dvec3& axis) {
    const glm::dvec3 across = before - glm::dot(before, axis) * axis;
    const double length = glm::length(across);
    return length > 1e-3 ? across / length : axesAcross(axis).first;
}

void appendRing(const Ring& ring, const glm::dvec3& first, MeshSource& mesh) {
    constexpr double halfSector = std::numbers::pi / tubeSectors;
    const double radius = ring.radius * halfSector / std::sin(halfSector);
    const glm::dvec3 second = glm::cross(ring.axis, first);
    for (unsigned k = 0; k < tubeSectors; ++k) {
        const double angle = 2 * halfSector * k;
        const glm::dvec3 outward = std::cos(angle) * first + std::sin(angle) * second;
        // Where a bend is narrower than the tube, the inner side of it is turned inside out, within the tube.
        const double along = std::max(ring.along - ring.radius * glm::dot(outward, ring.turn), 0.0);
        const glm::dvec3 normal = along * outward - ring.slope * ring.axis;
        mesh.positions.push_back(ring.centre + radius * outward);
        mesh.normals.push_back(glm::length(normal) > 0 ? glm::normalize(normal) : outward);
    }
}

/// On the inner side of a bend rings may go back, inside out: that is within the tube, and left out.
void appendTriangle(const std::array<unsigned, 3>& corners, MeshSource& mesh) {
    const glm::dvec3 a = mesh.positions[corners[0]], b = mesh.positions[corners[1]], c = mesh.positions[corners[2]];
    glm::dvec3 normal(0);
    for (const unsigned corner : corners) normal += mesh.normals[corner];
    if (!(glm::dot(glm::cross(b - a, c - a), normal) > 0)) return;
    std::array<MeshSource::Corner, 3> triangle;
    for (size_t k = 0; k < 3; ++k) triangle[k] = {corners[k], corners[k], QL_NONE, corners[k]};
    mesh.triangles.push_back(triangle);
}

} // namespace

void appendTube(const std::vector<Ring>& rings, MeshSource& mesh) {
    const auto base = static_cast<unsigned>(mesh.positions.size());
    glm::dvec3 first = axesAcross(rings.front().axis).first;
    for (const Ring& ring : rings) {
        first = carriedOn(first, ring.axis);
        appendRing(ring, first, mesh);
    }
    const auto corner = [&](size_t ring, unsigned sector) {
        return base + static_cast<unsigned>(ring) * tubeSectors + sector % tubeSectors;
    };
    for (size_t ring = 0; ring + 1 < rings.size(); ++ring)
        for (unsigned k = 0; k < tubeSectors; ++k) { // a ring of no radius is a point
            if (rings[ring].radius > 0)
                appendTriangle({corner(ring, k), corner(ring, k + 1), corner(ring + 1, k + 1)}, mesh);
            if (rings[ring + 1].radius > 0)
                appendTriangle({corner(ring, k), corner(ring + 1, k + 1), corner(ring + 1, k)}, mesh);
        }
}

Mesh tubeMesh(const MeshSource& tubes, const glm::dmat4& placement, const ShapeDescription& shape,
              const SourceLocation& file) {
    if (tubes.triangles.empty()) throw InputError(file, "the curves have no area: give them radii above 0.");
    return fileMesh(tubes, placement, shape.flipNormals, false, shape.where);
}

} // namespace quasilux
