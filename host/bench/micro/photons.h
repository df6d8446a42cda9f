// Photons of a box, as a photon pass leaves them, and points to gather at.
#pragma once

#include "bench/micro/traced_photons.h"
#include "micro/gather_types.h"

#include <vector>

namespace quasilux {

struct MicroPhotons {
    std::vector<TracedPhoton> photons;
    std::vector<size_t> regionEnds;           ///< where the photons of each region end
    std::vector<shared::GatherQuery> queries; ///< by tiles of the picture
    double density = 0;                       ///< photons per unit of area, mean
};

/// Photons where diffuse rays of the Cornell box end, in random order; queries where primary rays do.
MicroPhotons makePhotons(unsigned photons, unsigned queries);

} // namespace quasilux
