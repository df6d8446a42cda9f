// Where the flux of photons went (kernels/energy_balance.clh).
#pragma once

#include "pass_types.h"

namespace quasilux {

/// W, mean of R, G, B, over all photons of the passes counted.
struct EnergyBalance {
    double emitted = 0;
    double absorbed = 0;         ///< by surfaces and media, in expectation: flux times 1 - albedo
    double escaped = 0;          ///< left the scene
    double beyondDepth = 0;      ///< of paths that max_depth ended
    double cut = 0;              ///< of paths that the hard limit on events ended
    double lost = 0, gained = 0; ///< by chance (roulette, weights of samples): equal in the mean, not in a pass

    void add(const shared::RegionCount& count) {
        const auto term = [&](unsigned number) {
            return double(count.energy[number]) + double(count.energyRest[number]);
        };
        emitted += term(ENERGY_EMITTED);
        absorbed += term(ENERGY_ABSORBED);
        escaped += term(ENERGY_ESCAPED);
        beyondDepth += term(ENERGY_BEYOND_DEPTH);
        cut += count.fluxCut;
        lost += term(ENERGY_LOST);
        gained += term(ENERGY_GAINED);
    }

    EnergyBalance& operator+=(const EnergyBalance& other) {
        emitted += other.emitted;
        absorbed += other.absorbed;
        escaped += other.escaped;
        beyondDepth += other.beyondDepth;
        cut += other.cut;
        lost += other.lost;
        gained += other.gained;
        return *this;
    }

    EnergyBalance& operator*=(double factor) {
        for (double* term : {&emitted, &absorbed, &escaped, &beyondDepth, &cut, &lost, &gained}) *term *= factor;
        return *this;
    }

    /// What the other terms leave of the flux emitted, as a share of it: rounding, in a right render.
    double imbalance() const {
        const double rest = emitted - absorbed - escaped - beyondDepth - cut - (lost - gained);
        return emitted > 0 ? rest / emitted : rest;
    }
};

} // namespace quasilux
