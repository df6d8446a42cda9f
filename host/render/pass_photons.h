// The photons of a pass, as a map, or as several, one after the other, where the device has no room for all at once:
// traced, indexed and counted (stages 1 and 2).
#pragma once

#include "render/pass.h"
#include "render/photon_stage.h"

#include <functional>

namespace quasilux {

class PassPhotons {
public:
    /// `compile` launches the kernels that gather, with photons of the forecast; `counted` takes those that cross a
    /// meter, where there is one.
    PassPhotons(const PassContext& context, const std::function<void(const PhotonStage&)>& compile,
                MeterSums* counted = nullptr);

    /// Pass::forecast(): how many photons a pass leaves decides how large its buffers are.
    const MemoryForecast& forecast() const { return forecast_; }

    /// Of every pass.
    const std::vector<PassPart>& parts() const { return parts_; }
    void trace(unsigned pass, PassPart part, RenderCounters& counters);
    /// Once more, or for passes that others render: counted nowhere.
    void traceUncounted(unsigned pass, PassPart part);
    /// Does this render take light from photons at all?
    bool areTaken() const { return areTaken_; }
    /// Of the part traced last.
    const PhotonStage& stage() const { return *stage_; }

private:
    PhotonPassCount run(unsigned pass, PassPart part);

    const PassContext& context_;
    MemoryForecast forecast_;
    std::vector<PassPart> parts_;
    std::optional<PhotonStage> stage_;
    bool areTaken_;
    bool mapIsEmpty_ = false; // and stays so
};

} // namespace quasilux
