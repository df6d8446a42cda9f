// A few passes of one candidate.
#pragma once

#include "auto/prediction.h"
#include "render/renderer.h"

namespace quasilux {

class Pilot {
public:
    virtual ~Pilot() = default;
    /// The next pass, from 0 on.
    virtual void renderPass() = 0;
    virtual unsigned passes() const = 0;
    /// Errors relative to `brightness`, or to the pilot's own image where that is empty (errorByTile).
    virtual PilotMeasure measure(const std::vector<float>& brightness) const = 0;
    /// Of a camera path of each pixel that gathers no photons, before the first pass; 0 where it was not measured.
    virtual double secondsOfPath() = 0;
    /// What camera paths by pixel would gain with so many of the mean pixel. No pass may follow.
    virtual SamplingGain samplingGain(unsigned cameraPaths) = 0;
    /// Camera paths that this traces, as a multiple of the image's pixels.
    virtual double pathsOfSamplingGain(unsigned cameraPaths) const = 0;
    /// Of the scene, without compiling.
    virtual double secondsToPrepare() const = 0;
    /// Of all pixels.
    virtual std::vector<float> radiance() const = 0;
    virtual unsigned photonsPerPass() const = 0;
    /// Preparing and compiling, as far as measured by the first pass.
    virtual double openingSeconds() const = 0;
};

/// Passes of a renderer of its own.
class RendererPilot : public Pilot {
public:
    RendererPilot(Device& device, std::unique_ptr<Renderer> renderer, unsigned cameraPaths, bool hasMedia)
        : device_(device), renderer_(std::move(renderer)), cameraPaths_(cameraPaths), hasMedia_(hasMedia) {}

    void renderPass() override;
    unsigned passes() const override { return static_cast<unsigned>(renderer_->counters().passes); }
    PilotMeasure measure(const std::vector<float>& brightness) const override;
    double secondsOfPath() override;
    SamplingGain samplingGain(unsigned cameraPaths) override { return renderer_->samplingGain(cameraPaths); }
    double pathsOfSamplingGain(unsigned cameraPaths) const override {
        return renderer_->pathsOfSamplingGain(cameraPaths);
    }
    double secondsToPrepare() const override { return renderer_->counters().prepareSeconds; }
    std::vector<float> radiance() const override { return renderer_->develop().radiance; }
    unsigned photonsPerPass() const override { return renderer_->report().photonsPerPass; }
    double openingSeconds() const override;

    /// The pilot may not be used then.
    std::unique_ptr<Renderer> release() { return std::move(renderer_); }

private:
    struct PassSeconds {
        double photons = 0;    ///< traced and sorted
        double camera = 0;     ///< all else, but for choosing radii by pixel
        double wideCamera = 0; ///< camera paths with the largest discs, as far as measured while radii were chosen
    };
    double lateMedian(double PassSeconds::*part) const;
    double secondsPerPass() const;
    double gatheringSeconds(double cameraSeconds) const;
    double cameraSecondsWithoutDiscs() const;

    Device& device_;
    std::unique_ptr<Renderer> renderer_;
    unsigned cameraPaths_; // of a pixel in a pass
    bool hasMedia_;
    std::vector<PassSeconds> passes_;
    std::optional<double> secondsOfPath_;
};

} // namespace quasilux
