// Straight lines through logarithms: how one figure grows with another.
#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace quasilux {

/// y ~ x^exponent, by least squares in logarithms.
struct PowerLaw {
    double exponent = 0;
    double standardError = 0; ///< of the exponent, from how far the points lie off the line: noise and bends alike
};

/// Points that are not finite and positive are left out. Nothing where fewer than three, or a single x, remain.
std::optional<PowerLaw> fitPowerLaw(const std::vector<std::pair<double, double>>& points);

} // namespace quasilux
