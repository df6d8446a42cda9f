#include "render/radius.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;
constexpr double photonsInDisc = 300;

// Logarithm of the product of (k + alpha) / (k + 1) for k = 1 .. pass, in closed form.
double logShrink(unsigned pass) {
    const double n = pass;
    return std::lgamma(n + 1 + radiusAlpha) - std::lgamma(1 + radiusAlpha) - std::lgamma(n + 2);
}

} // namespace

double initialRadius(double area, unsigned photons) { return std::sqrt(photonsInDisc * area / (pi * photons)); }

double radiusOfPhotons(double perArea) { return std::sqrt(photonsInDisc / (pi * perArea)); }

double radiusShrink(unsigned pass) { return std::exp(logShrink(pass) / 2); }

double volumeShrink(unsigned pass) { return std::exp(logShrink(pass) / 3); }

double classRadiusFactor(unsigned lightClass) { return lightClass == LIGHT_CAUSTIC ? 0.5 : 1.0; }

} // namespace quasilux
