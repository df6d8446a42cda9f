// Photons that are hard to sort and to search: in clusters, alone, on the borders of cells, many at one point.
#pragma once

#include "support/photon_index.h"

#include <cstdint>
#include <vector>

namespace quasilux {

/// Flux from 0 to above 20,000 is stored in this unit.
inline constexpr float testFluxUnit = 16384;

/// Settings with that unit.
PhotonIndexSettings settingsOfFlux();

/// Flux as photons hold it, in that unit.
uint32_t packedFlux(float r, float g, float b);

/// All but its place and class follows from `id`.
TracedPhoton photonAt(float x, float y, float z, unsigned lightClass, unsigned id);

/// Clusters, lone photons, photons on the borders of cells of size `cell`, and many at one point; about `center`.
std::vector<TracedPhoton> awkwardPhotons(unsigned count, float center, float cell,
                                         const std::vector<unsigned>& classes);

} // namespace quasilux
