#include "render/flux_unit.h"

#include "prepare/device_scene.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// A photon carries at most three times its share of the emitted flux at first, which is a mean of R, G, B; shading
// normals may add to it. What is 2^-18 of it has little to say.
constexpr int headroomBits = 12;
// A guided photon may carry far more, where the guide expected hardly any. What is 2^-8 of a typical one has little to
// say.
constexpr int guidedHeadroomBits = 22;

float unitOf(double photonFlux, int headroom) {
    const double unit = std::ldexp(photonFlux, headroom);
    if (!(unit > 0) || !std::isfinite(unit)) return 1;
    return static_cast<float>(std::clamp(unit, 0x1p-90, 0x1p120));
}

} // namespace

float fluxUnit(double emittedFlux, unsigned paths) {
    return unitOf(3 * emittedFlux / std::max(1u, paths), headroomBits);
}

float fluxUnit(const DeviceScene& scene, unsigned paths) {
    if (!scene.isGuided) return fluxUnit(scene.emittedFlux, paths);
    return unitOf(3 * scene.typicalFlux / std::max(1u, paths), guidedHeadroomBits);
}

} // namespace quasilux
