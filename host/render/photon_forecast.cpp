#include "render/photon_forecast.h"

#include "render/method.h"
#include "render/pass_params.h"

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

PhotonForecast forecastPhotons(const PassContext& context, const Program& photonMap,
                               const std::function<void(const PhotonStage&)>& compile) {
    Device& device = context.device;
    const unsigned paths = std::min(forecastPaths, context.photons.paths);
    PhotonStage stage(device, photonMap, context.geometry, withPaths(context.photons, paths), context.classes,
                      storesDepth(context.flat, context.settings));
    std::optional<MeterSums> uncounted;
    if (meterCountsPhotons(context.flat.features, context.settings))
        stage.countAt(uncounted.emplace(device, context.classes, context.film.pixels(), meanRadiance(context.flat),
                                        context.flat.offsets.meter.samples));
    stage.useField(context.field);
    const PhotonPassCount counted = stage.run(forecastPass, {}, context.radii.radii(0), context.radii.volumeScale(0));
    stage.compile();
    if (compile) compile(stage);
    device.finish();
    return expectPass(counted, context.photons.paths);
}

PhotonForecast expectPass(const PhotonPassCount& counted, unsigned paths) {
    PhotonForecast result;
    const double traced = std::min(forecastPaths, paths), passesOverForecast = paths / traced;
    double kept = 0;
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c) {
        const auto inVolume = double(counted.stored[VOLUME_SLOT(c)]), onSurfaces = double(counted.stored[c]);
        const double keep = std::min(1.0, volumePhotonsPerPath * paths / std::max(passesOverForecast * inVolume, 1.0));
        result.keepProbability[c] = static_cast<float>(keep);
        kept += keep * inVolume + onSurfaces;
    }
    // The few paths may have met fewer than is usual.
    result.photonsOfPath = upperBound(kept / traced, traced) / traced;
    return result;
}

uint64_t PhotonForecast::stored(unsigned paths) const {
    return static_cast<uint64_t>(std::ceil(upperBound(photonsOfPath, paths)));
}

} // namespace quasilux
