// <shape type="linearcurve">: cones between balls, one at each control point, which they touch. Round at the joints and
// ends.
#include "scene/shapes/curve_file.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/shapes/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

constexpr double halfPi = std::numbers::pi / 2;
/// Of a ball, between two rings: a chord over it is off by its square / 8.
const double largestStep = std::sqrt(8 * tubeTolerance);

/// Where a cone touches a ball: a circle about `axis`, at `latitude` above the ball's equator.
struct Touch {
    glm::dvec3 axis{};
    double latitude = 0;
};

Ring ringOn(const CurvePoint& ball, const Touch& touch) {
    Ring ring;
    ring.axis = touch.axis;
    ring.centre = ball.position + ball.radius * std::sin(touch.latitude) * touch.axis;
    ring.along = std::cos(touch.latitude);
    ring.slope = -std::sin(touch.latitude);
    ring.radius = ring.along > 1e-9 ? ball.radius * ring.along : 0; // at the poles there is only a point
    return ring;
}

Touch touchBetween(const CurvePoint& from, const CurvePoint& to) {
    const glm::dvec3 across = to.position - from.position;
    const double length = glm::length(across);
    return {across / length, std::asin(std::clamp((from.radius - to.radius) / length, -1.0, 1.0))};
}

/// The part of the ball between two circles, the first of which has its ring already.
void appendBall(const CurvePoint& ball, const Touch& from, const Touch& to, std::vector<Ring>& rings) {
    const double angle = std::acos(std::clamp(glm::dot(from.axis, to.axis), -1.0, 1.0));
    const glm::dvec3 across = to.axis - glm::dot(from.axis, to.axis) * from.axis;
    const glm::dvec3 side = glm::length(across) > 1e-12 ? glm::normalize(across) : axesAcross(from.axis).first;
    const double range = angle + std::abs(to.latitude - from.latitude);
    const auto steps = static_cast<unsigned>(std::ceil(range / largestStep));
    for (unsigned k = 1; k <= steps; ++k) {
        const double share = double(k) / steps;
        rings.push_back(ringOn(ball, {std::cos(share * angle) * from.axis + std::sin(share * angle) * side,
                                      from.latitude + share * (to.latitude - from.latitude)}));
    }
}

/// Without points that are the same as the one before.
Curve withoutRepeats(const Curve& curve) {
    Curve apart;
    for (const CurvePoint& point : curve)
        if (apart.empty() || point.position != apart.back().position) apart.push_back(point);
    return apart;
}

std::vector<Ring> ringsOf(const Curve& curve) {
    Touch touch = touchBetween(curve[0], curve[1]);
    std::vector<Ring> rings = {ringOn(curve[0], {touch.axis, -halfPi})};
    appendBall(curve[0], {touch.axis, -halfPi}, touch, rings);
    for (size_t k = 1; k < curve.size(); ++k) {
        rings.push_back(ringOn(curve[k], touch));
        const Touch next = k + 1 < curve.size() ? touchBetween(curve[k], curve[k + 1]) : Touch{touch.axis, halfPi};
        appendBall(curve[k], touch, next, rings);
        touch = next;
    }
    return rings;
}

} // namespace

void readLinearCurve(Properties& properties, ShapeDescription& shape) {
    MeshSource mesh;
    for (const Curve& curve : readCurves(properties, 2)) {
        const Curve apart = withoutRepeats(curve);
        if (apart.size() < 2)
            throw InputError(properties.where("filename"),
                             "a curve's control points are all the same; set them apart.");
        appendTube(ringsOf(apart), mesh);
    }
    shape.mesh = tubeMesh(mesh, properties.placement(), shape, properties.where("filename"));
}

} // namespace quasilux
