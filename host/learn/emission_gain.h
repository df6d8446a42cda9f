// Does guided emission pay? Measured on photons that the guide at hand emitted and has not learned from.
#pragma once

#include "learned_types.h"

#include <vector>

namespace quasilux {

struct EmitterTables;

class EmissionGain {
public:
    /// The photons of a round.
    void add(const std::vector<shared::PhotonRecord>& photons, const EmitterTables& emitters);

    /// Noise times time that plain emission would leave, over what these photons leave. 1 where none of them serves the
    /// image.
    double ratio() const;

private:
    double noise_ = 0, plainNoise_ = 0, events_ = 0, plainEvents_ = 0;
};

} // namespace quasilux
