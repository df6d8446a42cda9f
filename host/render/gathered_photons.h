// Which photons of a pass its camera paths gather, by kernels/gathered_photons.cl: how much of the map serves the
// image.
#pragma once

#include "render/photon_stage.h"

#include <array>
#include <cstdint>
#include <string>

namespace quasilux {

struct PixelTables;

/// By slot of the map: classes on surfaces, then in media.
struct GatheredCount {
    std::array<uint64_t, PHOTON_SLOTS> stored{}, gathered{};

    /// Of all slots together; 0 where nothing was stored.
    double share() const;
};

/// `options` are those of the pass, `params` of its camera paths, `photons` hold its photons; Compiles a program for
/// it.
GatheredCount countGathered(Device& device, const std::string& options, const GeometryBuffers& geometry,
                            const PhotonStage& photons, const shared::CameraParams& params, const PixelTables& tables);

} // namespace quasilux
