// Circles in which spheres cut triangles and each other, as chords.
#include "prepare/border_intersections.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;
constexpr int chordsOfCircle = 128; // within 0.03 % of the radius

struct Circle {
    glm::dvec3 center, u, v; ///< u, v: orthonormal directions of its plane
    double radius;

    glm::dvec3 at(double angle) const { return center + radius * (std::cos(angle) * u + std::sin(angle) * v); }
};

Circle makeCircle(const glm::dvec3& center, const glm::dvec3& normal, double radius) {
    const glm::dvec3 other = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, other));
    return {center, u, glm::cross(normal, u), radius};
}

void appendArc(const Circle& circle, double from, double to, std::vector<CutSegment>& cuts) {
    const int pieces = std::max(1, int(std::ceil(chordsOfCircle * (to - from) / (2 * pi) - 1e-9)));
    glm::dvec3 start = circle.at(from);
    for (int i = 1; i <= pieces; ++i) {
        const glm::dvec3 end = circle.at(from + (to - from) * i / pieces);
        cuts.push_back({start, end});
        start = end;
    }
}

/// Angles, rising, at which the circle crosses the triangle's edges.
std::vector<double> crossings(const Circle& circle, const glm::dvec3 (&p)[3]) {
    std::vector<double> angles;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 from = p[i] - circle.center, along = p[(i + 1) % 3] - p[i];
        const double square = glm::dot(along, along), half = glm::dot(from, along);
        const double root = half * half - square * (glm::dot(from, from) - circle.radius * circle.radius);
        if (root <= 0) continue;
        for (const double t : {(-half - std::sqrt(root)) / square, (-half + std::sqrt(root)) / square}) {
            const glm::dvec3 point = from + t * along;
            if (t >= 0 && t <= 1) angles.push_back(std::atan2(glm::dot(point, circle.v), glm::dot(point, circle.u)));
        }
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

bool isInside(const glm::dvec3& point, const glm::dvec3 (&p)[3], const glm::dvec3& normal) {
    for (int i = 0; i < 3; ++i)
        if (glm::dot(normal, glm::cross(p[(i + 1) % 3] - p[i], point - p[i])) < 0) return false;
    return true;
}

} // namespace

void cutTriangleSphere(const Surface& surface, const SurfaceTriangle& triangle, const SurfaceSphere& sphere,
                       std::vector<CutSegment>& cuts) {
    const glm::dvec3 p[3] = {surface.vertices[triangle.corner[0]], surface.vertices[triangle.corner[1]],
                             surface.vertices[triangle.corner[2]]};
    const double tolerance = std::max(triangle.rounding, sphere.rounding);
    const double height = glm::dot(triangle.normal, sphere.center - p[0]);
    if (std::abs(height) >= sphere.radius - tolerance) return;
    const Circle circle = makeCircle(sphere.center - height * triangle.normal, triangle.normal,
                                     std::sqrt(sphere.radius * sphere.radius - height * height));
    std::vector<double> angles = crossings(circle, p);
    if (angles.empty()) angles.push_back(0);
    for (size_t i = 0; i < angles.size(); ++i) {
        const double from = angles[i], to = i + 1 < angles.size() ? angles[i + 1] : angles[0] + 2 * pi;
        if ((to - from) * circle.radius > tolerance && isInside(circle.at(0.5 * (from + to)), p, triangle.normal))
            appendArc(circle, from, to, cuts);
    }
}

void cutSpheres(const SurfaceSphere& a, const SurfaceSphere& b, std::vector<CutSegment>& cuts) {
    const double tolerance = std::max(a.rounding, b.rounding), distance = glm::distance(a.center, b.center);
    if (distance >= a.radius + b.radius - tolerance || distance <= std::abs(a.radius - b.radius) + tolerance) return;
    const glm::dvec3 axis = (b.center - a.center) / distance;
    const double along = 0.5 * (distance + (a.radius * a.radius - b.radius * b.radius) / distance);
    appendArc(makeCircle(a.center + along * axis, axis, std::sqrt(std::max(0.0, a.radius * a.radius - along * along))),
              0, 2 * pi, cuts);
}

} // namespace quasilux
