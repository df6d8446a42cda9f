// Winding numbers and volumes of shapes, and the innermost one about a point.
#include "prepare/media_bodies.h"

#include "scene/origin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

/// The corners of triangle `t`, seen from `origin`.
std::array<glm::dvec3, 3> cornersFrom(const Mesh& mesh, const glm::uvec3& triangle, const glm::dvec3& origin) {
    return {glm::dvec3(mesh.positions[triangle.x]) - origin, glm::dvec3(mesh.positions[triangle.y]) - origin,
            glm::dvec3(mesh.positions[triangle.z]) - origin};
}

/// Six times the volume between the triangle and the origin, > 0 where its normal points away.
double sixfoldVolume(const std::array<glm::dvec3, 3>& p) { return glm::dot(p[0], glm::cross(p[1], p[2])); }

/// Solid angle of a triangle seen from the origin, with the sign of sixfoldVolume: van Oosterom & Strackee 1983, "The
/// solid angle of a plane triangle", eq. 8.
double solidAngle(const std::array<glm::dvec3, 3>& p) {
    const double a = glm::length(p[0]), b = glm::length(p[1]), c = glm::length(p[2]);
    const double denominator =
        a * b * c + glm::dot(p[0], p[1]) * c + glm::dot(p[1], p[2]) * a + glm::dot(p[2], p[0]) * b;
    return 2 * std::atan2(sixfoldVolume(p), denominator);
}

} // namespace

MediumBody::MediumBody(const ShapeDescription& shape) : shape_(&shape), box_(boxOf(shape)) {
    double sixfold = 0;
    if (shape.sphere) {
        const double radius = shape.sphere->radius;
        sixfold = (shape.flipNormals ? -8 : 8) * pi * radius * radius * radius;
    } else {
        const glm::dvec3 middle = box_.center();
        for (const glm::uvec3& triangle : shape.mesh.triangles)
            sixfold += sixfoldVolume(cornersFrom(shape.mesh, triangle, middle));
    }
    volume_ = std::abs(sixfold) / 6;
    medium_ = (sixfold > 0 ? shape.interior : shape.exterior).value_or(MEDIUM_NONE);
}

double MediumBody::windingNumber(const glm::dvec3& point) const {
    double sum = 0;
    for (const glm::uvec3& triangle : shape_->mesh.triangles)
        sum += solidAngle(cornersFrom(shape_->mesh, triangle, point));
    return sum / (4 * pi);
}

bool MediumBody::holds(const glm::dvec3& point) const {
    if (glm::any(glm::lessThan(point, box_.lower)) || glm::any(glm::greaterThan(point, box_.upper))) return false;
    if (shape_->sphere) return glm::distance(point, glm::dvec3(shape_->sphere->center)) < shape_->sphere->radius;
    constexpr double rounding = 1e-6; // a plane, seen from on it, has exactly half
    return std::abs(windingNumber(point)) > 0.5 + rounding;
}

/// By the axes of the box and the plane of each triangle, two of the tests of Akenine-Moller (2001).
bool MediumBody::mayCross(const Box& box) const {
    if (!box_.overlaps(box)) return false;
    const glm::dvec3 middle = box.center(), half = 0.5 * box.extent();
    if (shape_->sphere) {
        const glm::dvec3 offset = glm::abs(glm::dvec3(shape_->sphere->center) - middle);
        const double radius = shape_->sphere->radius;
        return glm::length(glm::max(offset - half, 0.0)) <= radius && glm::length(offset + half) >= radius;
    }
    return std::any_of(shape_->mesh.triangles.begin(), shape_->mesh.triangles.end(), [&](const glm::uvec3& triangle) {
        const auto p = cornersFrom(shape_->mesh, triangle, middle);
        Box bounds;
        for (const glm::dvec3& corner : p) bounds.add(corner + middle);
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        return bounds.overlaps(box) && std::abs(glm::dot(normal, p[0])) <= glm::dot(glm::abs(normal), half);
    });
}

MediumBodies::MediumBodies(const Scene& scene) {
    for (const ShapeDescription& shape : scene.shapes)
        if (shape.interior || shape.exterior) bodies_.emplace_back(shape);
    std::stable_sort(bodies_.begin(), bodies_.end(),
                     [](const MediumBody& a, const MediumBody& b) { return a.volume() < b.volume(); });
    const glm::dvec3 sensor = scene.sensor.meter == MeterKind::area
                                  ? boxOf(scene.shapes[scene.sensor.meterShape]).center()
                                  : glm::dvec3(scene.sensor.toWorld[3]);
    const bool isOutside =
        std::none_of(bodies_.begin(), bodies_.end(), [&](const MediumBody& body) { return body.holds(sensor); });
    if (scene.sensor.medium && isOutside) outside_ = *scene.sensor.medium;
}

unsigned MediumBodies::mediumAt(const glm::dvec3& point) const {
    const auto body = std::find_if(bodies_.begin(), bodies_.end(),
                                   [&](const MediumBody& candidate) { return candidate.holds(point); });
    return body == bodies_.end() ? outside_ : body->medium();
}

unsigned MediumBodies::mediumOf(const Box& box) const {
    const bool isPoint = box.lower == box.upper;
    const bool isCrossed = !isPoint && std::any_of(bodies_.begin(), bodies_.end(),
                                                   [&](const MediumBody& body) { return body.mayCross(box); });
    return isCrossed ? MEDIUM_BY_PLACE : mediumAt(box.center());
}

unsigned MediumBodies::mediumAtMost(const std::vector<glm::dvec3>& points) const {
    std::map<unsigned, unsigned> votes;
    for (const glm::dvec3& point : points) ++votes[mediumAt(point)];
    const auto most =
        std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == votes.end() ? MEDIUM_NONE : most->first;
}

} // namespace quasilux
