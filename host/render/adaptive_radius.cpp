#include "render/adaptive_radius.h"

#include "render/coarse_camera.h"
#include "render/radius.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace quasilux {

namespace {

// The radii are chosen anew, and the coarse camera's discs narrowed, after so many of its passes; these end with the
// last choice.
constexpr std::array<unsigned, 4> choices{passesOfEqualRadius, 4, 8, 16};
constexpr unsigned foreseenPasses = 1024;
const std::string coarseOwner = "coarse ";

double squaredShrink(unsigned pass) { return radiusShrink(pass) * radiusShrink(pass); }

// With s_i the squared radius of pass i for scale 1: squared bias c^2 r^4 mean(s)^2, variance v mean(1 / s) / (N r^2).
// Their sum is least at r^6 = v / (2 c^2) times this. It hardly depends on N, since s_i falls as i^(-1/3).
double noiseToCurvature() {
    double mean = 0, meanInverse = 0;
    for (unsigned pass = 0; pass < foreseenPasses; ++pass) {
        mean += squaredShrink(pass) / foreseenPasses;
        meanInverse += 1 / squaredShrink(pass) / foreseenPasses;
    }
    return meanInverse / foreseenPasses / (mean * mean);
}

// How many choices are made from so many passes.
size_t choicesWithin(unsigned passes) {
    return std::upper_bound(choices.begin(), choices.end(), passes) - choices.begin();
}

std::string scalesLabel(size_t choice) { return "radii " + std::to_string(choice); }

// But for the coarse film's.
struct RadiusBuffers {
    RadiusBuffers(const shared::Camera& coarse, unsigned classes) {
        const size_t count = size_t(coarse.width) * coarse.height * size_t(std::popcount(classes));
        coarseScales.count = measures.count = count;
        for (size_t choice = 0; choice <= choices.size(); ++choice) scales.push_back({scalesLabel(choice), count});
    }
    PlannedBuffer<float> coarseScales{"coarse radii"};
    PlannedBuffer<shared::RadiusMeasure> measures{"coarse measures"};
    std::vector<PlannedBuffer<float>> scales; // as chosen
};

} // namespace

AdaptiveRadius::AdaptiveRadius(Device& device, const Program& pass, const shared::Camera& camera, unsigned classes)
    : block_(coarseBlock(camera)), camera_(coarseCamera(camera, block_)),
      film_(std::in_place, device, camera_.width, camera_.height, FilmLayout{}, Film::inOneBuffer, coarseOwner),
      measureRadii_(pass.kernel("measureRadii")), chooseRadii_(pass.kernel("chooseRadii")) {
    const RadiusBuffers buffers(camera_, classes);
    coarseScales_ = buffers.coarseScales.make(device);
    measures_ = buffers.measures.make(device);
    for (const auto& scales : buffers.scales) scales_.emplace_back(scales.make(device)).fill(1);
    coarseScales_.fill(largestAdaptiveRadius);
    measures_.write(std::vector<shared::RadiusMeasure>(measures_.size()));
}

BufferSizes AdaptiveRadius::plan(const shared::Camera& camera, unsigned classes) {
    const shared::Camera coarse = coarseCamera(camera, coarseBlock(camera));
    const RadiusBuffers buffers(coarse, classes);
    auto sizes = Film::plan(size_t(coarse.width) * coarse.height, FilmLayout{}, Film::inOneBuffer, coarseOwner);
    sizes.merge(sizesOf(buffers.coarseScales, buffers.measures));
    for (const auto& scales : buffers.scales) sizes.merge(sizesOf(scales));
    return sizes;
}

void AdaptiveRadius::compile() {
    const shared::RadiusParams nothing{};
    measureRadii_.launch(film_->pixels(), film_->sums(), coarseScales_, measures_, nothing);
    chooseRadii_.launch(film_->pixels(), film_->sums(), measures_, coarseScales_, scales_[0], scales_[1], nothing);
}

unsigned AdaptiveRadius::coarsePassesBefore(unsigned pass) {
    const size_t made = choicesWithin(pass);
    return made > 0 ? choices[made - 1] : 0;
}

const Buffer<float>& AdaptiveRadius::scales(unsigned pass) const { return scales_[choicesWithin(pass)]; }

void AdaptiveRadius::endCoarsePass() {
    squaredShrinks_ += squaredShrink(passes_);
    inverseShrinks_ += 1 / squaredShrink(passes_);
    ++passes_;
    const size_t made = choicesWithin(passes_);
    if (made == choicesWithin(passes_ - 1)) return;
    const shared::RadiusParams params{camera_.width,
                                      camera_.height,
                                      passes_,
                                      passes_ - (made > 1 ? choices[made - 2] : 0),
                                      static_cast<float>(squaredShrinks_),
                                      static_cast<float>(inverseShrinks_),
                                      static_cast<float>(noiseToCurvature()),
                                      largestAdaptiveRadius};
    squaredShrinks_ = inverseShrinks_ = 0;
    measureRadii_.launch(film_->pixels(), film_->sums(), coarseScales_, measures_, params);
    chooseRadii_.launch(film_->pixels(), film_->sums(), measures_, coarseScales_, scales_[made - 1], scales_[made],
                        params);
    if (passes_ >= choices.back()) endCoarsePasses();
}

void AdaptiveRadius::endCoarsePasses() {
    film_.reset();
    coarseScales_ = {};
    measures_ = {};
}

void AdaptiveRadius::save(StateSink& sink) const {
    sink.array("radii counts", std::vector<double>{double(passes_), squaredShrinks_, inverseShrinks_});
    for (size_t choice = 1; choice < scales_.size(); ++choice) sink.array(scalesLabel(choice), scales_[choice].read());
    if (!film_) return;
    film_->save(sink, "coarse film");
    sink.array("coarse radii", coarseScales_.read());
    sink.array("coarse measures", measures_.read());
}

void AdaptiveRadius::restore(const StateSource& source) {
    source.requireBytes("radii counts", 3 * sizeof(double));
    const auto counts = source.array<double>("radii counts");
    passes_ = static_cast<unsigned>(counts[0]);
    squaredShrinks_ = counts[1];
    inverseShrinks_ = counts[2];
    for (size_t choice = 1; choice < scales_.size(); ++choice) {
        source.requireBytes(scalesLabel(choice), scales_[choice].size() * sizeof(float));
        scales_[choice].write(source.array<float>(scalesLabel(choice)));
    }
    if (passes_ >= choices.back()) {
        endCoarsePasses();
        return;
    }
    film_->restore(source, "coarse film");
    source.requireBytes("coarse radii", coarseScales_.size() * sizeof(float));
    coarseScales_.write(source.array<float>("coarse radii"));
    source.requireBytes("coarse measures", measures_.size() * sizeof(shared::RadiusMeasure));
    measures_.write(source.array<shared::RadiusMeasure>("coarse measures"));
}

} // namespace quasilux
