#include "render/radius.h"

#include <cmath>

namespace quasilux {

namespace {

constexpr double pi = 3.141592653589793;
constexpr double photonsInDisc = 300;

} // namespace

double initialRadius(double area, unsigned photons) { return std::sqrt(photonsInDisc * area / (pi * photons)); }

double radiusShrink(unsigned pass) {
    // The product of (k + alpha) / (k + 1) for k = 1 .. pass in closed form.
    const double n = pass;
    const double logSquare = std::lgamma(n + 1 + radiusAlpha) - std::lgamma(1 + radiusAlpha) - std::lgamma(n + 2);
    return std::exp(0.5 * logSquare);
}

double classRadiusFactor(unsigned lightClass) { return lightClass == LIGHT_CAUSTIC ? 0.5 : 1.0; }

} // namespace quasilux
