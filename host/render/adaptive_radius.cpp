#include "render/adaptive_radius.h"

#include "render/radius.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quasilux {

namespace {

constexpr unsigned pilotPasses = 16;
constexpr double pilotSide = 128; // of the pilot's image, about: it is to cost little, whatever the size of the image
constexpr unsigned foreseenPasses = 1024;

double squaredShrink(unsigned pass) { return radiusShrink(pass) * radiusShrink(pass); }

// With s_i the squared radius of pass i for scale 1: squared bias c^2 r^4 mean(s)^2, variance v mean(1 / s) / (N r^2). Their
// sum is least at r^6 = v / (2 c^2) times this. It hardly depends on N, since s_i falls as i^(-1/3).
double noiseToCurvature() {
    double mean = 0, meanInverse = 0;
    for (unsigned pass = 0; pass < foreseenPasses; ++pass) {
        mean += squaredShrink(pass) / foreseenPasses;
        meanInverse += 1 / squaredShrink(pass) / foreseenPasses;
    }
    return meanInverse / foreseenPasses / (mean * mean);
}

unsigned blockSize(const shared::Camera& camera) {
    return static_cast<unsigned>(
        std::max(1.0, std::round(std::sqrt(double(camera.width) * camera.height) / pilotSide)));
}

shared::Camera coarseCamera(shared::Camera camera, unsigned block) {
    camera.width = (camera.width + block - 1) / block;
    camera.height = (camera.height + block - 1) / block;
    for (auto* step : {&camera.stepX, &camera.stepY}) {
        step->x *= static_cast<float>(block);
        step->y *= static_cast<float>(block);
        step->z *= static_cast<float>(block);
    }
    return camera;
}

size_t scaleCount(const shared::Camera& pilot, unsigned classes) {
    return size_t(pilot.width) * pilot.height * size_t(std::popcount(classes));
}

} // namespace

AdaptiveRadius::AdaptiveRadius(Device& device, const Program& pass, const shared::Camera& camera, unsigned classes)
    : block_(blockSize(camera)), camera_(coarseCamera(camera, block_)),
      film_(std::in_place, device, camera_.width, camera_.height, true, "pilot's "),
      measureRadii_(pass.kernel("measureRadii")), chooseRadii_(pass.kernel("chooseRadii")),
      scales_(device, scaleCount(camera_, classes), "radii"), pilotScales_(device, scales_.size(), "pilot's radii"),
      measures_(device, scales_.size(), "pilot's measures") {
    scales_.fill(1);
    pilotScales_.fill(largestAdaptiveRadius);
}

std::map<std::string, uint64_t> AdaptiveRadius::plan(const shared::Camera& camera, unsigned classes) {
    const shared::Camera pilot = coarseCamera(camera, blockSize(camera));
    const uint64_t scales = scaleCount(pilot, classes);
    return {{"pilot's film", uint64_t(pilot.width) * pilot.height * Film::floatsPerPixel(true) * sizeof(float)},
            {"pilot's camera counters", sizeof(shared::CameraCounters)},
            {"radii", scales * sizeof(float)},
            {"pilot's radii", scales * sizeof(float)},
            {"pilot's measures", scales * sizeof(shared::RadiusMeasure)}};
}

void AdaptiveRadius::compile() {
    const shared::RadiusParams nothing{};
    measureRadii_.launch(film_->pixels(), film_->sums(), measures_, nothing);
    chooseRadii_.launch(film_->pixels(), measures_, scales_, nothing);
}

void AdaptiveRadius::endPilotPass(unsigned pass) {
    squaredRadii_ += squaredShrink(pass) * largestAdaptiveRadius * largestAdaptiveRadius;
    inverseSquares_ += 1 / (squaredShrink(pass) * largestAdaptiveRadius * largestAdaptiveRadius);
    ++passes_;
    if (passes_ < passesOfEqualRadius || !std::has_single_bit(passes_)) return;
    const shared::RadiusParams params{camera_.width,
                                      camera_.height,
                                      passes_,
                                      static_cast<float>(squaredRadii_),
                                      static_cast<float>(inverseSquares_),
                                      static_cast<float>(noiseToCurvature()),
                                      largestAdaptiveRadius};
    measureRadii_.launch(film_->pixels(), film_->sums(), measures_, params);
    chooseRadii_.launch(film_->pixels(), measures_, scales_, params);
    if (passes_ < pilotPasses) return;
    film_.reset();
    pilotScales_ = {};
    measures_ = {};
}

} // namespace quasilux
