#include "photometry/photometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

constexpr double radiansPerDegree = std::numbers::pi / 180;
constexpr double curveStep = 0.05; // degrees, between places where a curve is followed

/// From gamma = `from` in steps of `direction` to where less than `level` is left, interpolated; at most 180 degrees.
double angleTo(const Goniogram& goniogram, double c, double from, double direction, double level) {
    double before = intensityInPlane(goniogram, c, from);
    for (int k = 1; k * curveStep <= 180; ++k) {
        const double here = intensityInPlane(goniogram, c, from + direction * k * curveStep);
        if (here < level) return curveStep * (k - (level - here) / (before - here));
        before = here;
    }
    return 180;
}

PlaneAngles anglesOfPlane(const Goniogram& goniogram, double c) {
    double peak = 0, where = 0;
    // The axis first, so that of equal intensities those nearest to it count.
    for (int k = 0; k * curveStep <= 180; ++k)
        for (const double sign : {1.0, -1.0}) {
            const double here = intensityInPlane(goniogram, c, sign * k * curveStep);
            if (here <= peak * (1 + 1e-9)) continue;
            peak = here;
            where = sign * k * curveStep;
        }
    const auto angleAt = [&](double share) {
        return angleTo(goniogram, c, where, 1, share * peak) + angleTo(goniogram, c, where, -1, share * peak);
    };
    return {c, angleAt(0.5), angleAt(0.1)};
}

double upwardLumens(const Goniogram& goniogram) {
    if (goniogram.isOfAxis) return goniogram.lumensBeyond(90);
    constexpr int rows = 180, columns = 360;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double gamma = 90 + 90 * (i + 0.5) / rows;
        for (int k = 0; k < columns; ++k)
            sum +=
                goniogram.intensity(directionAt(360 * (k + 0.5) / columns, gamma)) * std::sin(gamma * radiansPerDegree);
    }
    return sum * (std::numbers::pi / 2 / rows) * (2 * std::numbers::pi / columns);
}

void findLargest(const Goniogram& goniogram, Photometry& out) {
    const auto at = std::max_element(goniogram.candela.begin(), goniogram.candela.end());
    const auto index = static_cast<size_t>(at - goniogram.candela.begin());
    const double polar = goniogram.polar[index % goniogram.polar.size()] * radiansPerDegree,
                 turn = goniogram.azimuth[index / goniogram.polar.size()] * radiansPerDegree;
    const glm::dvec3 d = goniogram.axes * glm::dvec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                                     std::cos(polar));
    out.largest = *at;
    out.largestGamma = std::atan2(std::hypot(d.x, d.y), d.z) / radiansPerDegree;
    const double c = std::hypot(d.x, d.y) > 1e-9 ? std::atan2(-d.y, d.x) / radiansPerDegree : 0;
    out.largestC = c < -1e-9 ? c + 360 : c > 1e-9 ? c : 0;
}

std::vector<LuminanceRow> luminancesOf(const Goniogram& goniogram) {
    std::vector<LuminanceRow> rows;
    if (goniogram.shape.kind == LuminousShape::Kind::point) return rows;
    const auto luminance = [&](double c, double gamma) {
        const glm::dvec3 d = directionAt(c, gamma);
        const double area = goniogram.shape.projectedArea(d);
        return area > 0 ? goniogram.intensity(d) / area : 0;
    };
    for (int k = 0; k <= 8; ++k) {
        const double gamma = 45 + 5 * k;
        LuminanceRow row{gamma, luminance(0, gamma), luminance(90, gamma), 0};
        for (int c = 0; c < 360; ++c) row.highest = std::max(row.highest, luminance(c, gamma));
        rows.push_back(row);
    }
    return rows;
}

} // namespace

double intensityInPlane(const Goniogram& goniogram, double c, double gamma) {
    // Beside the axis, since on it a direction has no C. Beyond 180 degrees it goes on in the other half plane.
    return goniogram.intensity(directionAt(c, gamma == 0 ? 1e-7 : gamma));
}

Photometry photometryOf(const Goniogram& goniogram) {
    Photometry out;
    const LampSet& lamps = goniogram.lampSets.at(goniogram.lampSet);
    out.lumens = goniogram.lumens();
    out.upwardLumens = upwardLumens(goniogram);
    out.lampLumens = lamps.lumens;
    out.watts = lamps.watts;
    findLargest(goniogram, out);
    out.planes = {anglesOfPlane(goniogram, 0), anglesOfPlane(goniogram, 90)};
    out.luminances = luminancesOf(goniogram);
    return out;
}

} // namespace quasilux
