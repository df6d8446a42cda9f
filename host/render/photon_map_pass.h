// --map photons: camera paths gather from a map of photons (stage 3 of a pass, camera_stage.h).
#pragma once

#include "render/camera_stage.h"
#include "render/noise_probe.h"
#include "render/pass_photons.h"

namespace quasilux {

class PhotonMapPass : public Pass {
public:
    explicit PhotonMapPass(const PassContext& context);

    void run(unsigned pass, RenderCounters& counters) override;
    uint64_t cameraPaths() const override { return camera_->paths().sum() * photonParts(); }
    unsigned photonParts() const override { return photons_->parts().front().count; }
    double secondsWithoutGathering() override;
    SamplingGain samplingGain(unsigned paths) override;
    std::optional<GatheredCount> countGathered(unsigned pass) override;
    bool radiiAreChosen() const override;
    void saveRadii(StateSink& sink) const override;
    void restoreRadii(const StateSource& source) override;

private:
    NoiseProbe noiseProbe(unsigned paths);
    void allocatePaths();
    void catchUpRadii(unsigned pass, RenderCounters& counters);
    void chooseRadii(unsigned pass, PassPart part, RenderCounters& counters);

    const PassContext& context_;
    std::optional<AdaptiveRadius> radii_;  ///< by pixel, where they are
    std::optional<SharedSamples> samples_; ///< of a filter wider than a pixel
    std::optional<CameraStage> camera_;
    std::optional<PassPhotons> photons_;
};

} // namespace quasilux
