// Directions to the sky, by degrees.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <numbers>

namespace quasilux {

inline constexpr double degree = std::numbers::pi / 180;

/// Unit, z up, azimuth from x to y.
inline glm::dvec3 towards(double zenith, double azimuth = 0) {
    return {std::sin(zenith * degree) * std::cos(azimuth * degree),
            std::sin(zenith * degree) * std::sin(azimuth * degree), std::cos(zenith * degree)};
}

} // namespace quasilux
