// --map photons where the sensor is a meter or a grid: its paths gather from a map of photons, which are also counted
//   as they cross it (stage 3 of
// a pass, meter_stage.h).
#pragma once

#include "render/meter_stage.h"
#include "render/pass_photons.h"

namespace quasilux {

class MeterPass : public Pass {
public:
    explicit MeterPass(const PassContext& context);

    void run(unsigned pass, RenderCounters& counters) override;
    uint64_t cameraPaths() const override;
    unsigned photonParts() const override { return photons_.parts().front().count; }

private:
    const PassContext& context_;
    MeterStage meter_;
    PassPhotons photons_;
};

} // namespace quasilux
