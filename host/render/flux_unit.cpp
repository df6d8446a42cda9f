#include "render/flux_unit.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// A photon carries at most three times its share of the emitted flux at first, which is a mean of R, G, B; shading
// normals may add to it. What is 2^-18 of it has little to say.
constexpr int headroomBits = 12;

} // namespace

float fluxUnit(double emittedFlux, unsigned paths) {
    const double share = 3 * emittedFlux / std::max(1u, paths), unit = std::ldexp(share, headroomBits);
    if (!(unit > 0) || !std::isfinite(unit)) return 1;
    return static_cast<float>(std::clamp(unit, 0x1p-90, 0x1p120));
}

} // namespace quasilux
