#include "scene/goniograms/goniogram.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;

/// Between which two entries of `angles` an angle lies, and how far from the first.
struct GridPlace {
    size_t first;
    double share;
};
GridPlace gridPlaceOf(const std::vector<double>& angles, double angle) {
    const auto above = std::upper_bound(angles.begin(), angles.end(), angle);
    if (above == angles.end()) return {angles.size() - 2, 1};
    const auto k = static_cast<size_t>(std::max<std::ptrdiff_t>(above - angles.begin() - 1, 0));
    return {k, std::max(angle - angles[k], 0.0) / (angles[k + 1] - angles[k])};
}

/// Integrals of (1 - t) sin and t sin from polar angle a to b, t from 0 at a to 1 at b.
std::pair<double, double> linearTimesSine(double a, double b) {
    // Of the whole, cos a - cos b, without a loss of digits.
    const double whole = 2 * std::sin((a + b) / 2) * std::sin((b - a) / 2);
    if (b - a < 1e-5) return {whole / 2, whole / 2}; // finer than any goniometer; below, the difference has no digits
    const double upper = (std::sin(b) - std::sin(a)) / (b - a) - std::cos(b);
    return {whole - upper, upper};
}

// Less of a shape's sides is rounding: directions come from angles and from transforms in single precision.
constexpr double edgeOn = 1e-6;

/// Of a direction whose components are not negative.
double areaAlong(const LuminousShape& shape, const glm::dvec3& d) {
    constexpr double quarter = std::numbers::pi / 4;
    const double x = d.x, y = d.y, z = d.z, a = shape.sizeC0, b = shape.sizeC90, h = shape.height;
    using Kind = LuminousShape::Kind;
    switch (shape.kind) {
    case Kind::point:
        return 0;
    case Kind::box:
        return a * b * z + b * h * x + a * h * y;
    case Kind::uprightRod:
        return quarter * a * b * z + h * std::hypot(b * x, a * y);
    case Kind::rodAlongC0:
        return quarter * b * h * x + a * std::hypot(b * z, h * y);
    case Kind::rodAlongC90:
        return quarter * a * h * y + b * std::hypot(a * z, h * x);
    case Kind::ellipsoid:
        return quarter * std::hypot(b * h * x, a * h * y, a * b * z);
    }
    return 0;
}

} // namespace

double LuminousShape::projectedArea(const glm::dvec3& d) const {
    const double a = sizeC0, b = sizeC90, h = height, area = areaAlong(*this, glm::abs(d));
    return area > edgeOn * std::max({a * b, b * h, a * h}) ? area : 0;
}

bool LuminousShape::hasArea() const { return areaAlong(*this, {1, 1, 1}) > 0; }

std::string LuminousShape::text() const {
    const auto sizes = [](double a, double b) { return fmt::format("{:.4g} m × {:.4g} m", a, b); };
    switch (kind) {
    case Kind::point:
        return "point";
    case Kind::box:
        if (height > 0) return fmt::format("box {} × {:.4g} m", sizes(sizeC0, sizeC90), height);
        return "rectangle " + sizes(sizeC0, sizeC90);
    case Kind::uprightRod:
        if (height > 0) return fmt::format("upright cylinder {} × {:.4g} m", sizes(sizeC0, sizeC90), height);
        if (sizeC0 == sizeC90) return fmt::format("disc of diameter {:.4g} m", sizeC0);
        return "ellipse " + sizes(sizeC0, sizeC90);
    case Kind::rodAlongC0:
        if (sizeC0 == 0) return "ellipse that faces C0, " + sizes(sizeC90, height);
        return fmt::format("cylinder along C0, {:.4g} m long, {} across", sizeC0, sizes(sizeC90, height));
    case Kind::rodAlongC90:
        if (sizeC90 == 0) return "ellipse that faces C90, " + sizes(sizeC0, height);
        return fmt::format("cylinder along C90, {:.4g} m long, {} across", sizeC90, sizes(sizeC0, height));
    case Kind::ellipsoid:
        return fmt::format("ellipsoid {} × {:.4g} m", sizes(sizeC0, sizeC90), height);
    }
    return {};
}

glm::dvec3 directionAt(double c, double gamma) {
    const double across = std::sin(gamma * radiansPerDegree);
    return {across * std::cos(c * radiansPerDegree), -across * std::sin(c * radiansPerDegree),
            std::cos(gamma * radiansPerDegree)};
}

double Goniogram::intensity(const glm::dvec3& direction) const {
    const glm::dvec3 d = glm::transpose(axes) * direction;
    const double turn = std::atan2(d.y, d.x) / radiansPerDegree;
    const GridPlace column = gridPlaceOf(azimuth, turn < 0 ? turn + 360 : turn);
    const GridPlace row = gridPlaceOf(polar, std::atan2(std::hypot(d.x, d.y), d.z) / radiansPerDegree);
    const auto along = [&](size_t k) { return std::lerp(at(k, row.first), at(k, row.first + 1), row.share); };
    return std::lerp(along(column.first), along(column.first + 1), column.share);
}

double Goniogram::lumensBeyond(double angle) const {
    double sum = 0;
    for (size_t row = 0; row + 1 < polar.size(); ++row) {
        const double from = std::max(polar[row], angle), to = polar[row + 1];
        if (from >= to) continue;
        const double share = (from - polar[row]) / (to - polar[row]);
        const auto weights = linearTimesSine(from * radiansPerDegree, to * radiansPerDegree);
        const auto ofPlane = [&](size_t k) {
            return weights.first * std::lerp(at(k, row), at(k, row + 1), share) + weights.second * at(k, row + 1);
        };
        for (size_t k = 0; k + 1 < azimuth.size(); ++k)
            sum += (azimuth[k + 1] - azimuth[k]) * radiansPerDegree / 2 * (ofPlane(k) + ofPlane(k + 1));
    }
    return sum;
}

double Goniogram::largest() const { return *std::max_element(candela.begin(), candela.end()); }

double Goniogram::tiltFactor(double degrees, const SourceLocation& where) const {
    if (tilt.degrees.empty()) return 1;
    if (!(degrees >= tilt.degrees.front() && degrees <= tilt.degrees.back()))
        throw InputError(where, fmt::format("a tilt of {} degrees; the table of '{}' has {} to {}.", degrees, path,
                                            tilt.degrees.front(), tilt.degrees.back()));
    if (tilt.degrees.size() == 1) return tilt.factors.front();
    const GridPlace place = gridPlaceOf(tilt.degrees, degrees);
    return std::lerp(tilt.factors[place.first], tilt.factors[place.first + 1], place.share);
}

} // namespace quasilux
