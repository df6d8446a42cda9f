// Photons of a few passes as the photon stage stores them, read back from the map.
#pragma once

#include "device/program.h"
#include "prepare/device_scene.h"
#include "render/settings.h"
#include "support/render_statistics.h"
#include "support/traversal_device.h"

#include <array>
#include <vector>

namespace quasilux {

struct StoredPhoton {
    float x, y, z;
    shared::Rgb flux; ///< W; in a medium not yet divided by its extinction
};
/// By slot of the map, for each pass.
using StoredPasses = std::vector<std::array<std::vector<StoredPhoton>, PHOTON_SLOTS>>;

struct PhotonTracing {
    std::string options;                                  ///< to the compiler, beside those of the scene
    std::array<float, LIGHT_CLASSES> keep = {1, 1, 1, 1}; ///< of photons in media
    unsigned seed = 7;
    KernelSources replaced = {};
    unsigned paths = 20'000, passes = 12;
    float radius = 1;
};

StoredPasses tracePhotons(const DeviceScene& flat, const RenderSettings& settings, const PhotonTracing& tracing);

/// Flux of the direct photons of 50,000 paths a pass, as a share of what the scene emits.
MeanAndError directShareOfFlux(const DeviceScene& flat, const RenderSettings& settings);

} // namespace quasilux
