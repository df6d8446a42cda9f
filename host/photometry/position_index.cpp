#include "photometry/position_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace quasilux {

namespace {

constexpr double degreesPerRadian = 180 / std::numbers::pi;
// Bounds of evalglare, by which published values of the daylight glare probability were found.
constexpr double largestOfDaylight = 16, largestRatio = 3;

} // namespace

double positionIndex(const LineOfSight& sight, const glm::dvec3& towards) {
    const double cosine = glm::dot(towards, sight.direction);
    if (cosine <= 0) return std::numeric_limits<double>::infinity();
    const glm::dvec3 across = towards - cosine * sight.direction;
    const double sine = glm::length(across);
    if (sine < 1e-9) return 1;
    const glm::dvec3 upright = glm::normalize(sight.up - glm::dot(sight.up, sight.direction) * sight.direction);
    const double sigma = degreesPerRadian * std::atan2(sine, cosine),
                 tau = degreesPerRadian * std::acos(std::clamp(std::abs(glm::dot(across, upright)) / sine, 0.0, 1.0));
    const double linear = 35.2 - 0.31889 * tau - 1.22 * std::exp(-2 * tau / 9),
                 square = 21 + 0.26667 * tau - 0.002963 * tau * tau;
    return std::max(1.0, std::exp(sigma * (linear * 1e-3 + sigma * square * 1e-5)));
}

double positionIndexOfDaylight(const LineOfSight& sight, const glm::dvec3& towards) {
    const double cosine = glm::dot(towards, sight.direction);
    const glm::dvec3 across = towards - cosine * sight.direction;
    if (cosine <= 0) return positionIndex(sight, towards);
    if (glm::dot(across, sight.up) >= 0) return std::min(positionIndex(sight, towards), largestOfDaylight);
    const double ratio = std::min(glm::length(across) / cosine, largestRatio);
    return 1 + (ratio < 0.6 ? 0.8 : 1.2) * ratio;
}

} // namespace quasilux
