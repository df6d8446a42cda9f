// Photons made by a test, indexed by the kernels of kernels/photon_map.cl and record_sort.cl as the renderer does it.
#pragma once

#include "bench/micro/traced_photons.h"
#include "device/program.h"
#include "render/cell_table.h"

#include <array>
#include <vector>

namespace quasilux {

struct PhotonIndexSettings {
    unsigned classes = 1u << LIGHT_DIFFUSE; ///< bits 1 << LIGHT_* of the classes stored
    std::array<float, LIGHT_CLASSES> radius{1, 1, 1, 1};
    unsigned cells = 4096; ///< of one class, a power of two, at least 4
    SortParts parts{3, true};
    unsigned regions = 7; ///< they hold unequal numbers of photons, some none
    bool storesDepth = false;
    float fluxUnit = 1; ///< shared::MapParams::fluxUnit
    shared::RadiusField field{};
};

struct PhotonIndex {
    shared::MapParams map{};
    size_t photons = 0;
    Buffer<uint32_t> cellStart, sorted;

    /// Field PHOTON_* (kernels/photon_grid.clh) of all sorted photons, as bits.
    std::vector<uint32_t> field(unsigned number) const {
        return sorted.read(size_t(number) * map.photonStride, photons);
    }
};

/// The photons keep their order: photon i comes before photon i + 1 as traced.
PhotonIndex indexPhotons(const std::vector<TracedPhoton>& photons, const PhotonIndexSettings& settings);

/// Compiler options of these settings, for kernels that include density.clh.
std::string photonIndexOptions(const PhotonIndexSettings& settings);

} // namespace quasilux
