#include "scene/skies/hosek_wilkie.h"

#include "scene/skies/hosek_wilkie_data.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

constexpr double degree = pi / 180;
constexpr double discAngle = 0.5358 * degree; // Hosek & Wilkie 2013
// The RGB data are integrals over wavelengths; by that of the eye's response they become means (CIE 1931, in nm).
constexpr double responseIntegral = 106.75025939941406;
// From the unit of the sun's data to that of the sky's (Mitsuba 3).
constexpr double sunFactor = 467.069280386;

/// Between two entries of a table, which belong to whole numbers.
struct TablePlace {
    int below;
    double share; ///< of the entry above
};
TablePlace placeBetween(double place, int last) {
    const int below = std::clamp(static_cast<int>(place), 0, last - 1);
    return {below, std::clamp(place - below, 0.0, 1.0)};
}

/// Weights of the control points: Bernstein polynomials of degree 5 of the third root of the elevation (2012, section 5).
std::array<double, hosekWilkieControlPoints> controlWeights(double elevation) {
    const double x = std::cbrt(std::clamp(2 * elevation / pi, 0.0, 1.0)), y = 1 - x;
    return {y * y * y * y * y,      5 * x * y * y * y * y, 10 * x * x * y * y * y,
            10 * x * x * x * y * y, 5 * x * x * x * x * y, x * x * x * x * x};
}

/// An entry of a table by turbidity, albedo and control point, whose records have `size` numbers.
double interpolate(const double* table, int size, int entry, double turbidity, double albedo,
                   const std::array<double, hosekWilkieControlPoints>& weights) {
    const TablePlace t = placeBetween(turbidity - 1, hosekWilkieTurbidities - 1);
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        const int bright = k / 2, hazy = k % 2;
        const double weight = (bright ? albedo : 1 - albedo) * (hazy ? t.share : 1 - t.share);
        const double* records =
            table + ((t.below + hazy) * 2 + bright) * hosekWilkieControlPoints * static_cast<ptrdiff_t>(size);
        for (int point = 0; point < hosekWilkieControlPoints; ++point)
            sum += weight * weights[static_cast<size_t>(point)] * records[point * size + entry];
    }
    return sum;
}

/// Cubic through the middle two of four values at -1, 0, 1, 2 (Catmull & Rom 1974).
double cubicThrough(const std::array<double, 4>& v, double x) {
    return v[1] +
           x / 2 * (v[2] - v[0] + x * (2 * v[0] - 5 * v[1] + 4 * v[2] - v[3] + x * (3 * (v[1] - v[2]) + v[3] - v[0])));
}

/// Polynomial of a record of the sun's table.
double atLimb(const double* powers, double cosSurface) {
    double sum = 0;
    for (int k = hosekWilkieLimbPowers; k-- > 0;) sum = sum * cosSurface + powers[k];
    return sum;
}

} // namespace

double hosekWilkieSunAperture() { return discAngle; }
double hosekWilkieResponse() { return responseIntegral; }

HosekWilkieSky::HosekWilkieSky(double turbidity, Rgb albedo, double sunElevation) {
    const auto weights = controlWeights(sunElevation);
    const double albedos[3] = {albedo.r, albedo.g, albedo.b};
    for (int c = 0; c < 3; ++c) {
        Channel& channel = channels_.at(static_cast<size_t>(c));
        for (int k = 0; k < hosekWilkieShapeParameters; ++k)
            channel.shape.at(static_cast<size_t>(k)) =
                interpolate(hosekWilkieSkyShape, 3 * hosekWilkieShapeParameters, c * hosekWilkieShapeParameters + k,
                            turbidity, albedos[c], weights);
        channel.radiance = interpolate(hosekWilkieSkyRadiance, 3, c, turbidity, albedos[c], weights) / responseIntegral;
    }
}

glm::dvec3 HosekWilkieSky::radiance(double cosZenith, double cosSun) const {
    const double angle = std::acos(std::clamp(cosSun, -1.0, 1.0)), squared = cosSun * cosSun;
    glm::dvec3 found;
    for (int c = 0; c < 3; ++c) {
        const auto& [s, radiance] = channels_.at(static_cast<size_t>(c));
        // 2012, eq. 8; the data have I before H.
        const double around = 1 + s[8] * s[8] - 2 * s[8] * cosSun;
        const double glow = (1 + squared) / (around * std::sqrt(around));
        found[c] = radiance * (1 + s[0] * std::exp(s[1] / (cosZenith + 0.01))) *
                   (s[2] + s[3] * std::exp(s[4] * angle) + s[5] * squared + s[6] * glow +
                    s[7] * std::sqrt(std::max(cosZenith, 0.0)));
    }
    return found;
}

glm::dvec3 HosekWilkieSun::radiance(double elevation, double cosSurface) const {
    constexpr int last = hosekWilkieSunElevations - 1, record = 3 * hosekWilkieLimbPowers;
    const TablePlace t = placeBetween(turbidity_ - 1, hosekWilkieTurbidities - 1);
    const TablePlace e = placeBetween(last * std::cbrt(std::max(2 * elevation / pi, 0.0)), last);
    glm::dvec3 found{0};
    for (int hazy = 0; hazy < 2; ++hazy)
        for (int c = 0; c < 3; ++c) {
            const auto at = [&](int row) {
                return atLimb(hosekWilkieSun + (t.below + hazy) * hosekWilkieSunElevations * record + row * record +
                                  c * hosekWilkieLimbPowers,
                              cosSurface);
            };
            std::array<double, 4> v{0, at(e.below), at(e.below + 1), 0};
            v[0] = e.below > 0 ? at(e.below - 1) : 2 * v[1] - v[2]; // straight on at the ends
            v[3] = e.below + 2 <= last ? at(e.below + 2) : 2 * v[2] - v[1];
            found[c] += (hazy ? t.share : 1 - t.share) * cubicThrough(v, e.share);
        }
    return found * (sunFactor / responseIntegral);
}

glm::dvec3 HosekWilkieSun::discMean(double elevation) const {
    constexpr int rings = 32, sectors = 16;
    glm::dvec3 sum{0};
    for (int ring = 0; ring < rings; ++ring) {
        const double area = (ring + 0.5) / rings, away = std::sqrt(area); // of the radius
        for (int sector = 0; sector < sectors; ++sector) {
            const double up = away * std::sin(2 * pi * (sector + 0.5) / sectors) * discAngle / 2;
            sum += radiance(elevation + up, std::sqrt(1 - area));
        }
    }
    return sum / double(rings * sectors);
}

glm::dvec3 HosekWilkieSun::meanRadiance(double elevation) const {
    constexpr double first = 2 * degree, step = 3 * degree;
    const TablePlace e = placeBetween((elevation - first) / step, 29);
    return discMean(first + step * e.below) * (1 - e.share) + discMean(first + step * (e.below + 1)) * e.share;
}

} // namespace quasilux
