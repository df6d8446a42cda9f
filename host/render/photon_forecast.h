// A few photons traced apart from all passes: how many a pass will store decides its buffers and how they are thinned.
#pragma once

#include "render/pass.h"
#include "render/photon_stage.h"

#include <functional>

namespace quasilux {

/// What a pass is to expect.
struct PhotonForecast {
    /// Photons in media are many where a path collides often: as many of a class are kept as serve the estimate.
    std::array<float, LIGHT_CLASSES> keepProbability{1, 1, 1, 1};
    double photonsOfPath = 0; ///< that one stores, at most in all likelihood

    /// That so many paths store, at most in all likelihood.
    uint64_t stored(unsigned paths) const;
};

constexpr unsigned forecastPaths = 2048;
constexpr unsigned forecastPass = UINT32_MAX; // no render gets there

/// Traces the few photons with a program of --map photons, which compiles its kernels: the runtime does when they are
/// first launched. `compile` launches those that gather, with these photons, if there are any.
PhotonForecast forecastPhotons(const PassContext& context, const Program& photonMap,
                               const std::function<void(const PhotonStage&)>& compile = {});

/// From the count of `forecastPaths` photons, or of all where a pass has fewer, to a pass of `paths`.
PhotonForecast expectPass(const PhotonPassCount& counted, unsigned paths);

} // namespace quasilux
