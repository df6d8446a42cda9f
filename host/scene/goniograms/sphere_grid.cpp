#include "scene/goniograms/sphere_grid.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Angles that differ by less are one: files round them.
constexpr double sameAngle = 1e-6;

double wrapped(double angle) {
    const double turn = angle - 360 * std::floor(angle / 360);
    return 360 - turn < sameAngle ? 0 : turn;
}

/// Of the range that is dark: black from there on.
HalfPlane darkPlane(double azimuth, size_t rows) { return {azimuth, std::vector<double>(rows, 0.0)}; }

/// What lies between the last plane and the first one, at azimuth 0.
HalfPlane seamOf(const HalfPlane& last, const HalfPlane& first) {
    const double share = (360 - last.azimuth) / (first.azimuth + 360 - last.azimuth);
    HalfPlane seam{0, first.candela};
    for (size_t k = 0; k < seam.candela.size(); ++k)
        seam.candela[k] = std::lerp(last.candela[k], first.candela[k], share);
    return seam;
}

/// Puts one at 0 and one at 360.
void closeRound(std::vector<HalfPlane>& planes) {
    if (planes.front().azimuth > sameAngle) planes.insert(planes.begin(), seamOf(planes.back(), planes.front()));
    planes.front().azimuth = 0;
    if (planes.back().azimuth >= 360 - sameAngle)
        planes.back().azimuth = 360;
    else
        planes.push_back({360, planes.front().candela});
}

void closeDark(std::vector<HalfPlane>& planes, size_t rows) {
    if (planes.front().azimuth > 0) {
        const double first = planes.front().azimuth;
        planes.insert(planes.begin(), {darkPlane(0, rows), darkPlane(first, rows)});
    }
    if (planes.back().azimuth < 360) {
        planes.push_back(darkPlane(planes.back().azimuth, rows));
        planes.push_back(darkPlane(360, rows));
    }
}

} // namespace

void mirrorPlanes(std::vector<HalfPlane>& planes, double axis) {
    const size_t given = planes.size();
    for (size_t k = 0; k < given; ++k) {
        const double mirrored = wrapped(2 * axis - planes[k].azimuth);
        const bool isThere = std::any_of(planes.begin(), planes.end(), [&](const HalfPlane& plane) {
            return std::abs(wrapped(plane.azimuth) - mirrored) < sameAngle;
        });
        if (!isThere) planes.push_back({mirrored, planes[k].candela});
    }
    for (HalfPlane& plane : planes) plane.azimuth = wrapped(plane.azimuth);
    std::sort(planes.begin(), planes.end(),
              [](const HalfPlane& a, const HalfPlane& b) { return a.azimuth < b.azimuth; });
}

void setSphere(Goniogram& goniogram, const std::vector<double>& polar, std::vector<HalfPlane> planes, bool goesRound) {
    if (goesRound)
        closeRound(planes);
    else
        closeDark(planes, polar.size());
    const bool darkAbove = polar.front() > 0, darkBelow = polar.back() < 180;
    goniogram.polar = polar;
    if (darkAbove) goniogram.polar.insert(goniogram.polar.begin(), {0.0, polar.front()});
    if (darkBelow) goniogram.polar.insert(goniogram.polar.end(), {polar.back(), 180.0});
    goniogram.azimuth.clear();
    goniogram.candela.clear();
    for (const HalfPlane& plane : planes) {
        goniogram.azimuth.push_back(plane.azimuth);
        if (darkAbove) goniogram.candela.insert(goniogram.candela.end(), 2, 0.0);
        goniogram.candela.insert(goniogram.candela.end(), plane.candela.begin(), plane.candela.end());
        if (darkBelow) goniogram.candela.insert(goniogram.candela.end(), 2, 0.0);
    }
}

} // namespace quasilux
