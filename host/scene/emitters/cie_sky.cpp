#include "scene/emitters/cie_sky.h"

#include "scene/skies/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

// CIE S 011, table 1: gradation a, b and scattering indicatrix c, d, e.
struct SkyParameters {
    double a, b, c, d, e;
};
constexpr std::array<SkyParameters, cieSkyTypes - 1> skyParameters{{{4, -0.7, 0, -1, 0},
                                                                    {4, -0.7, 2, -1.5, 0.15},
                                                                    {1.1, -0.8, 0, -1, 0},
                                                                    {1.1, -0.8, 2, -1.5, 0.15},
                                                                    {0, -1, 0, -1, 0},
                                                                    {0, -1, 2, -1.5, 0.15},
                                                                    {0, -1, 5, -2.5, 0.3},
                                                                    {0, -1, 10, -3, 0.45},
                                                                    {-1, -0.55, 2, -1.5, 0.15},
                                                                    {-1, -0.55, 5, -2.5, 0.3},
                                                                    {-1, -0.55, 10, -3, 0.45},
                                                                    {-1, -0.32, 10, -3, 0.45},
                                                                    {-1, -0.32, 16, -3, 0.3},
                                                                    {-1, -0.15, 16, -3, 0.3},
                                                                    {-1, -0.15, 24, -2.8, 0.15}}};

/// By the cosine of the angle from the zenith.
double gradation(const SkyParameters& p, double cosine) {
    return 1 + (cosine > 0 ? p.a * std::exp(p.b / cosine) : 0); // there, eq. 3
}

/// By the cosine of the angle from the sun.
double indicatrix(const SkyParameters& p, double cosine) {
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    return 1 + p.c * (std::exp(p.d * angle) - std::exp(p.d * std::numbers::pi / 2)) + p.e * cosine * cosine; // eq. 5
}

} // namespace

bool dependsOnSun(int type) {
    if (type == cieSkyTypes) return false;
    const SkyParameters& p = skyParameters.at(static_cast<size_t>(type) - 1);
    return p.c != 0 || p.e != 0;
}

double cieSkyLuminance(int type, const glm::dvec3& direction, const glm::dvec3& sun) {
    if (direction.z < 0) return 0;
    if (type == cieSkyTypes) return (1 + 2 * direction.z) / 3; // eq. 8
    const SkyParameters& p = skyParameters.at(static_cast<size_t>(type) - 1);
    return indicatrix(p, glm::dot(direction, sun)) * gradation(p, direction.z) /
           (indicatrix(p, sun.z) * gradation(p, 1));
}

double cieSkyIlluminance(int type, const glm::dvec3& sun) {
    return illuminanceOnGround([&](const glm::dvec3& direction) { return cieSkyLuminance(type, direction, sun); });
}

} // namespace quasilux
