#include "auto/pilot.h"

#include "render/camera_stage.h"

#include <algorithm>

namespace quasilux {

namespace {

struct Seconds {
    double camera = 0, all = 0;
};

Seconds kernelSeconds(Device& device) {
    Seconds sum;
    for (const auto& [kernel, timing] : device.timings()) {
        sum.all += timing.seconds;
        if (kernel == cameraKernel) sum.camera += timing.seconds;
    }
    return sum;
}

} // namespace

void RendererPilot::renderPass() {
    const Seconds before = kernelSeconds(device_);
    renderer_->renderPass(passes());
    const Seconds after = kernelSeconds(device_);
    cameraSeconds_ += after.camera - before.camera;
    kernelSeconds_ += after.all - before.all;
}

PilotMeasure RendererPilot::measure() const {
    PilotMeasure pilot = measurePilot(image(), hasMedia_, secondsPerPass());
    if (kernelSeconds_ > 0) pilot.photonShare = 1 - cameraSeconds_ / kernelSeconds_;
    return pilot;
}

// The first pass pays for what the runtime compiles only then.
double RendererPilot::secondsPerPass() const {
    const RenderCounters& counters = renderer_->counters();
    if (counters.passes < 2) return counters.firstPassSeconds;
    return (counters.renderSeconds - counters.firstPassSeconds) / static_cast<double>(counters.passes - 1);
}

double RendererPilot::openingSeconds() const {
    const RenderCounters& counters = renderer_->counters();
    const double late = std::max(0.0, counters.firstPassSeconds - secondsPerPass());
    return counters.prepareSeconds + counters.compileSeconds + late;
}

} // namespace quasilux
