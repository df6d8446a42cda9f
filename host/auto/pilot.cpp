#include "auto/pilot.h"

#include "render/camera_stage.h"

#include <algorithm>
#include <limits>

namespace quasilux {

namespace {

double photonSeconds(Device& device) {
    double seconds = 0;
    for (const auto& [kernel, timing] : device.timings())
        if (kernel != cameraKernel) seconds += timing.seconds;
    return seconds;
}

// Of a medium's kernel where there is one, else of the widest class.
double radiusOf(const SceneReport& report) {
    double radius = 0;
    for (const auto& medium : report.media) radius = std::max(radius, medium.kernelRadius);
    for (const auto& [name, ofClass] : report.initialRadius)
        if (report.media.empty()) radius = std::max(radius, ofClass);
    return radius > 0 ? radius : 1;
}

// Of all emitters.
double radianceByFlux(const SceneReport& report) {
    double power = 0, sum = 0;
    for (const auto& emitter : report.emitters) {
        power += emitter.power;
        sum += emitter.power * emitter.radiance;
    }
    return power > 0 ? sum / power : 0;
}

} // namespace

void RendererPilot::renderPass() {
    secondsOfPath();
    const double photonsBefore = photonSeconds(device_);
    const RenderCounters before = renderer_->counters();
    renderer_->renderPass(passes());
    const RenderCounters& after = renderer_->counters();
    const double radius = after.radiusSeconds - before.radiusSeconds;
    PassSeconds seconds;
    seconds.photons = photonSeconds(device_) - photonsBefore;
    seconds.camera = after.renderSeconds - before.renderSeconds - radius - seconds.photons;
    if (const uint64_t paths = after.radiusPaths - before.radiusPaths; paths > 0)
        seconds.wideCamera = radius * double(after.cameraPaths - before.cameraPaths) / double(paths);
    passes_.push_back(seconds);
}

double RendererPilot::secondsOfPath() {
    if (!secondsOfPath_) secondsOfPath_ = renderer_->secondsWithoutGathering();
    return *secondsOfPath_;
}

PilotMeasure RendererPilot::measure(const std::vector<float>& brightness) const {
    const double photons = lateMedian(&PassSeconds::photons), camera = lateMedian(&PassSeconds::camera);
    const SceneReport& report = renderer_->report();
    PilotMeasure pilot =
        measurePilot(renderer_->develop(), hasMedia_, photons + camera, brightness, radianceByFlux(report));
    pilot.findsCaustics = report.photonClasses.empty();
    if (pilot.findsCaustics) pilot.noiseOfPhotons = 0;
    pilot.secondsOfPhotons = photons + gatheringSeconds(camera);
    pilot.radius = radiusOf(report);
    pilot.secondsWithRadius = std::max(0.0, camera - cameraSecondsWithoutDiscs());
    return pilot;
}

// The part of a pass's `cameraSeconds` that gathering takes; 0 where it was not measured.
double RendererPilot::gatheringSeconds(double cameraSeconds) const {
    const double ofPath = secondsOfPath_.value_or(0);
    return ofPath > 0 ? std::max(0.0, cameraSeconds - cameraPaths_ * ofPath) : 0;
}

double RendererPilot::secondsPerPass() const {
    return lateMedian(&PassSeconds::photons) + lateMedian(&PassSeconds::camera);
}

// The first pass pays for what the runtime compiles only then, others for a busy machine; and passes grow cheaper as
// radii shrink. So the median of the second half predicts best what those to come will take.
double RendererPilot::lateMedian(double PassSeconds::*part) const {
    std::vector<double> seconds;
    for (size_t pass = passes_.size() / 2; pass < passes_.size(); ++pass) seconds.push_back(passes_[pass].*part);
    if (seconds.empty()) return 0;
    const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
    std::nth_element(seconds.begin(), middle, seconds.end());
    return *middle;
}

// Until radii are chosen, the paths that choose them differ from those of the pass by discs of largestAdaptiveRadius^2
// the area. What does not grow with the area will not fall with it. As long as nothing is known, all of it.
double RendererPilot::cameraSecondsWithoutDiscs() const {
    constexpr double area = largestAdaptiveRadius * largestAdaptiveRadius;
    const size_t last = std::min<size_t>(passesOfEqualRadius, passes_.size());
    double camera = 0, wide = 0, passes = 0;
    for (size_t pass = 1; pass < last; ++pass, ++passes) {
        camera += passes_[pass].camera;
        wide += passes_[pass].wideCamera;
    }
    if (wide == 0) return std::numeric_limits<double>::infinity();
    return std::max(0.0, area * camera - wide) / (area - 1) / passes;
}

double RendererPilot::openingSeconds() const {
    const RenderCounters& counters = renderer_->counters();
    const double late = std::max(0.0, counters.firstPassSeconds - secondsPerPass());
    return counters.prepareSeconds + counters.compileSeconds + late;
}

} // namespace quasilux
