// A search among pilots that render nothing: what each would measure is said by the test.
#pragma once

#include "auto/search.h"
#include "support/even_pilot.h"
#include "support/render_statistics.h"
#include "util/error.h"

#include <atomic>
#include <functional>
#include <memory>
#include <new>
#include <optional>

namespace quasilux {

struct Truth {
    double secondsPerPass = 0.1, noisePerPass = 1, bias = 0;
    double firstNoise = 0; // estimated before `honestFrom` passes, all of it even; 0: honest from the start
    unsigned honestFrom = 0;
    unsigned failsAt = 0; // pass that throws, counted from 1; 0: none
    bool lacksMemory = false;
    double secondsToPrepare = 0;
    SamplingGain samplingGain{};
    double pathsOfSamplingGain = 0;
    double noiseOfPhotons = 0, shareOfPhotonSeconds = 0; // as PilotMeasure
};
using World = std::function<Truth(const RenderSettings&)>;

class FakePilot : public Pilot {
public:
    FakePilot(const Truth& truth, unsigned photons, double& clock) : truth_(truth), photons_(photons), clock_(clock) {}
    void renderPass() override {
        if (passes_ + 1 == truth_.failsAt) {
            if (truth_.lacksMemory) throw std::bad_alloc();
            throw DeviceError("the device is lost");
        }
        clock_ += truth_.secondsPerPass;
        ++passes_;
    }
    unsigned passes() const override { return passes_; }
    double secondsOfPath() override { return (1 - truth_.shareOfPhotonSeconds) * truth_.secondsPerPass; }
    SamplingGain samplingGain(unsigned) override { return truth_.samplingGain; }
    double pathsOfSamplingGain(unsigned) const override { return truth_.pathsOfSamplingGain; }
    double secondsToPrepare() const override { return truth_.secondsToPrepare; }
    std::vector<float> radiance() const override { return {}; }
    PilotMeasure measure(const std::vector<float>&) const override {
        const bool lies = passes_ < truth_.honestFrom;
        PilotMeasure pilot =
            evenPilot(passes_, lies ? truth_.firstNoise : truth_.noisePerPass, truth_.bias, truth_.secondsPerPass);
        pilot.noiseOfPhotons = truth_.noiseOfPhotons;
        pilot.secondsOfPhotons = truth_.shareOfPhotonSeconds * truth_.secondsPerPass;
        return pilot;
    }
    unsigned photonsPerPass() const override { return photons_; }
    double openingSeconds() const override { return 0.05; }

private:
    Truth truth_;
    unsigned photons_, passes_ = 0;
    double& clock_;
};

struct Found {
    RenderSettings settings;
    SearchReport report;
};

inline Found search(const World& world, double seconds, Freedom freedom = {true, true, true, true, true},
                    std::optional<double> error = std::nullopt, const RenderSettings& start = {},
                    size_t mostOpen = 1000, const std::atomic<bool>* interrupted = nullptr) {
    double clock = 0;
    SearchWorld searched;
    searched.interrupted = interrupted;
    searched.open = [&](const RenderSettings& settings) {
        clock += 0.05;
        const unsigned photons = settings.photonsPerPass > 0 ? settings.photonsPerPass : 1000;
        return std::make_unique<FakePilot>(world(settings), photons, clock);
    };
    searched.clock = [&] { return clock; };
    searched.mostOpen = mostOpen;
    const Scene scene = projectScene("cornell_phong.xml");
    StopRule stop;
    stop.seconds = seconds;
    stop.relativeError = error;
    auto result = Search(searched, scene, freedom, stop).run(start, searched.open(start));
    return {result.settings, result.report};
}

} // namespace quasilux
