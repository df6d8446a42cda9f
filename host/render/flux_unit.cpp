#include "render/flux_unit.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// A photon carries at most three times its share of the emitted flux at first, which is a mean of R, G, B; shading normals may
// add to it. What is 2^-18 of it has little to say.
constexpr int headroomBits = 12;

} // namespace

float fluxUnit(double emittedFlux, unsigned paths) {
    const double share = 3 * emittedFlux / std::max(1u, paths);
    const int exponent = share > 0 && std::isfinite(share) ? std::ilogb(share) + 1 + headroomBits : 0;
    return static_cast<float>(std::ldexp(1.0, std::clamp(exponent, -90, 120)));
}

} // namespace quasilux
