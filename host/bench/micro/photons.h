// Photons of a box, as a photon pass leaves them, and points to gather at.
#pragma once

#include "micro/gather_types.h"
#include "pass_types.h"

#include <vector>

namespace quasilux {

struct MicroPhotons {
    std::vector<shared::Photon> photons; ///< by region, each full
    std::vector<shared::RegionCount> regions;
    unsigned regionCapacity = 0;
    std::vector<shared::GatherQuery> queries; ///< by tiles of the picture
    double density = 0;                       ///< photons per unit of area, mean
};

/// Photons where diffuse rays of the Cornell box end, in random order; queries where primary rays do.
MicroPhotons makePhotons(unsigned photons, unsigned queries);

} // namespace quasilux
