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
    const double secondsBefore = renderer_->counters().renderSeconds;
    renderer_->renderPass(passes());
    const Seconds after = kernelSeconds(device_);
    cameraSeconds_ += after.camera - before.camera;
    kernelSeconds_ += after.all - before.all;
    if (passes() > 1) passSeconds_.push_back(renderer_->counters().renderSeconds - secondsBefore);
}

PilotMeasure RendererPilot::measure() const {
    PilotMeasure pilot = measurePilot(image(), hasMedia_, secondsPerPass());
    if (kernelSeconds_ > 0) pilot.photonShare = 1 - cameraSeconds_ / kernelSeconds_;
    return pilot;
}

// The first pass pays for what the runtime compiles only then, and some of the early ones for choosing radii by pixel, so
// what most passes take is their median.
double RendererPilot::secondsPerPass() const {
    if (passSeconds_.empty()) return renderer_->counters().firstPassSeconds;
    std::vector<double> seconds = passSeconds_;
    const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
    std::nth_element(seconds.begin(), middle, seconds.end());
    return *middle;
}

double RendererPilot::openingSeconds() const {
    const RenderCounters& counters = renderer_->counters();
    const double late = std::max(0.0, counters.firstPassSeconds - secondsPerPass());
    return counters.prepareSeconds + counters.compileSeconds + late;
}

} // namespace quasilux
