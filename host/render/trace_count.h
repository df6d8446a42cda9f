// What tracing photons counts, summed over the regions of a pass.
#pragma once

#include "render/energy_balance.h"

#include <cstdint>

namespace quasilux {

struct TraceCount {
    uint64_t cutPaths = 0, nonFinite = 0; ///< in the camera map's order also of camera paths
    uint64_t overflows = 0;               ///< sums of splats or of a meter that left the range of their fixed point
    uint64_t clipped = 0;                 ///< photons with more flux than packed flux holds (kernels/packed_flux.clh)
    uint64_t meterCaustics = 0;           ///< caustic and quasi-caustic photons that were counted at a meter
    double fluxCut = 0;                   ///< of cut photons, W
    EnergyBalance energy;                 ///< counted only where the kernels are compiled with ENERGY_BALANCE

    void add(const shared::RegionCount& count) {
        cutPaths += count.cutPaths;
        nonFinite += count.nonFinite;
        overflows += count.overflows;
        clipped += count.clipped;
        meterCaustics += count.meterCaustics;
        fluxCut += count.fluxCut;
        energy.add(count);
    }

    /// Of flux: what was traced is this share of a pass, though it carries all of its flux.
    void weigh(double share) {
        fluxCut *= share;
        energy *= share;
    }
};

} // namespace quasilux
