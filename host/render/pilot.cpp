#include "render/pilot.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Kept of a class, per photon emitted: those of one path are strongly correlated (docs/method/media.md).
constexpr double volumePhotonsPerPath = 3;
// Standard deviations of room: what does not fit is traced again, which takes time only.
constexpr double spread = 4;

/// Photons of `count` paths that leave `perPath` on average: path lengths vary as roulette makes them, geometrically.
double upperBound(double perPath, double count) {
    return perPath * count + spread * std::sqrt(count * perPath * (perPath + 1));
}

} // namespace

PilotResult expectPass(const PhotonPassCount& counted, unsigned paths) {
    PilotResult result;
    const double traced = std::min(pilotPaths, paths), passesOverPilot = paths / traced;
    double kept = 0;
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
        const auto inVolume = double(counted.stored[VOLUME_SLOT(c)]), onSurfaces = double(counted.stored[c]);
        const double keep = std::min(1.0, volumePhotonsPerPath * paths / std::max(passesOverPilot * inVolume, 1.0));
        result.keepProbability[c] = static_cast<float>(keep);
        kept += keep * inVolume + onSurfaces;
    }
    // The pilot itself may have met fewer than is usual.
    const double perPath = upperBound(kept / traced, traced) / traced;
    result.photons = static_cast<uint64_t>(std::ceil(upperBound(perPath, paths)));
    return result;
}

} // namespace quasilux
