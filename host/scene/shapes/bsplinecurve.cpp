// <shape type="bsplinecurve">: tubes about uniform cubic B-splines, whose radius is one too. Open at the ends.
#include "scene/shapes/curve_file.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/shapes/tube.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr size_t order = 4; // control points of a segment
using Place = glm::dvec4;   // point and radius

/// A segment as a polynomial of u in [0, 1]: sum of coefficient[k] u^k.
struct Segment {
    Place coefficient[order];

    explicit Segment(const CurvePoint* p) {
        const auto place = [&](size_t k) { return Place(p[k].position, p[k].radius); };
        coefficient[0] = (place(0) + 4.0 * place(1) + place(2)) / 6.0;
        coefficient[1] = (place(2) - place(0)) / 2.0;
        coefficient[2] = (place(0) - 2.0 * place(1) + place(2)) / 2.0;
        coefficient[3] = (place(3) - place(0) + 3.0 * (place(1) - place(2))) / 6.0;
    }
    Place at(double u) const {
        return coefficient[0] + u * (coefficient[1] + u * (coefficient[2] + u * coefficient[3]));
    }
    Place derivative(double u) const { return coefficient[1] + u * (2.0 * coefficient[2] + 3 * u * coefficient[3]); }
    Place second(double u) const { return 2.0 * coefficient[2] + 6 * u * coefficient[3]; }
};

/// Pieces that the segment is cut into, so that chords keep within the tolerance and turn by no more than 0.1 from one
/// to the next.
unsigned piecesOf(const Segment& segment, double largestRadius) {
    constexpr double largestTurn = 0.1;
    constexpr unsigned samples = 16;
    if (!(largestRadius > 0)) return 1;
    // The second derivative is linear in u, so that one of its ends is the largest. A chord over h is off by h² / 8 of
    // it.
    const double bend = std::max(glm::length(segment.second(0)), glm::length(segment.second(1)));
    double turn = 0;
    for (unsigned k = 0; k < samples; ++k) {
        const glm::dvec3 a = segment.derivative(double(k) / samples), b = segment.derivative(double(k + 1) / samples);
        if (glm::length(a) > 0 && glm::length(b) > 0)
            turn += std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0, 1.0));
    }
    const double pieces = std::max(std::sqrt(bend / (8 * tubeTolerance * largestRadius)), turn / largestTurn);
    return static_cast<unsigned>(std::clamp(std::ceil(pieces), 1.0, 1e4));
}

Ring ringAt(const Segment& segment, double u) {
    const Place place = segment.at(u), slope = segment.derivative(u);
    const glm::dvec3 velocity = slope, acceleration = segment.second(u);
    Ring ring;
    ring.centre = place;
    ring.radius = place.w;
    ring.along = glm::length(velocity);
    ring.slope = slope.w;
    if (!(ring.along > 0)) return ring; // set from its neighbours
    ring.axis = velocity / ring.along;
    ring.turn = (acceleration - glm::dot(acceleration, ring.axis) * ring.axis) / ring.along;
    return ring;
}

/// Where control points are repeated the curve stands still, and its axis is that to the next place.
void setAxesAtRest(std::vector<Ring>& rings, const SourceLocation& where) {
    double length = 0;
    for (size_t k = 0; k + 1 < rings.size(); ++k) length += glm::length(rings[k + 1].centre - rings[k].centre);
    if (!(length > 0)) throw InputError(where, "a curve's control points are all the same; set them apart.");
    for (size_t k = 0; k < rings.size(); ++k) {
        if (rings[k].along > 1e-9 * length) continue;
        const glm::dvec3 chord = rings[std::min(k + 1, rings.size() - 1)].centre - rings[k == 0 ? 0 : k - 1].centre;
        const double chordLength = glm::length(chord);
        rings[k].axis = chordLength > 0 ? chord / chordLength : rings[k == 0 ? 0 : k - 1].axis;
        rings[k].along = 1;
        rings[k].slope = 0;
        rings[k].turn = glm::dvec3(0);
    }
}

} // namespace

void readBsplineCurve(Properties& properties, ShapeDescription& shape) {
    MeshSource mesh;
    for (const Curve& curve : readCurves(properties, order)) {
        std::vector<Ring> rings;
        for (size_t first = 0; first + order <= curve.size(); ++first) {
            const Segment segment(&curve[first]);
            double largest = 0;
            for (size_t k = first; k < first + order; ++k) largest = std::max(largest, curve[k].radius);
            const unsigned pieces = piecesOf(segment, largest);
            for (unsigned k = first == 0 ? 0 : 1; k <= pieces; ++k)
                rings.push_back(ringAt(segment, double(k) / pieces));
        }
        setAxesAtRest(rings, properties.where("filename"));
        appendTube(rings, mesh);
    }
    shape.mesh = tubeMesh(mesh, properties.placement(), shape, properties.where("filename"));
}

} // namespace quasilux
