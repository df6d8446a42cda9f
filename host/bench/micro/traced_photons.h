// Photons made on the host, laid out as tracing leaves them (kernels/photon_store.clh).
#pragma once

#include "device/buffer.h"
#include "pass_types.h"

#include <cstdint>
#include <vector>

namespace quasilux {

/// Fields as PHOTON_* of kernels/photon_grid.clh.
struct TracedPhoton {
    shared::Packed3 position{};
    uint32_t flux = 0, patchSide = 0, direction = 0, depth = 0;
    uint32_t slot = 0; ///< of the map
};

struct TracedLayout {
    std::vector<uint32_t> arrays, blocks;
    std::vector<shared::RegionCount> regions;
};

/// Arrays of `stride` words; the photons of the regions, `regionEnds` of which says where each ends, stand in blocks
/// that the regions take in turns.
TracedLayout layOutPhotons(const std::vector<TracedPhoton>& photons, const std::vector<size_t>& regionEnds,
                           size_t stride, bool storesDepth);

} // namespace quasilux
