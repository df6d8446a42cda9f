#include "render/film.h"

#include "render/film_layout.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

using namespace filmLayout;

// Pixel positions are spread evenly over passes in a row, so batches estimate the variance of the mean with less bias; but of few passes
// single ones estimate it with less variance. Bias is estimated in the middle half of each batch of four, about whose middle
// the radii are even, and in all passes before: half the cost, and no change of its mean.
constexpr unsigned singlePasses = 16, batchPasses = 4;

// How often the film was added to.
struct Counts {
    double passes, batches;
    double openWeight; // 1 / passes of the open batch, 0 if there is none
};

// Standard error of the mean from the sum over passes, the squares of batches, each divided by its number of passes, and
// the sum over the open batch.
float standardError(double sum, double squares, double open, const Counts& n) {
    if (n.batches < 2) return 0;
    const double all = squares + open * open * n.openWeight;
    return static_cast<float>(std::sqrt(std::max(0.0, all - sum * sum / n.passes) / (n.passes * (n.batches - 1))));
}

// The same of the bias, in the terms of its own passes.
struct BiasCounts {
    double passes, squares; // sums over batches of their passes and of the squares of their passes
};

// Standard error of the mean bias from the sum over passes and the squares of batches S_b of m_b passes. Its noise grows
// as discs shrink, and early passes make up more batches than late ones: divided by m_b, as those of the image are,
// the squares estimated 0.77 of its variance after 64 passes. For independent batches with one mean and any variances,
//     E [sum S_b^2 - q S^2] = (1 - q) Var S,    q = sum m_b^2 / n^2.
// The estimate has little variance as long as a pass's noise is not much less than its mean, which holds for the bias, but not for the image.
float biasStandardError(double sum, double squares, double open, const BiasCounts& n) {
    const double share = n.squares / (n.passes * n.passes);
    if (share >= 1) return 0;
    const double variance = std::max(0.0, squares + open * open - share * sum * sum) / (1 - share);
    return static_cast<float>(std::sqrt(variance) / n.passes);
}

void developPixel(const float* pixel, size_t first, const Counts& n, FilmImage& image) {
    for (size_t channel = 0; channel < 3; ++channel) {
        const size_t at = first + channel;
        double total = 0;
        for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
            const double sum = valueOf(pixel + k * sumFloats, channel);
            image.components[k][at] = static_cast<float>(sum / n.passes);
            total += sum;
            if (k >= LIGHT_CLASSES) continue;
            const double squares = valueOf(pixel + classSquares + k * sumFloats, channel);
            image.componentError[k][at] = standardError(sum, squares, pixel[classBatch + 3 * k + channel], n);
        }
        image.radiance[at] = static_cast<float>(total / n.passes);
        image.standardError[at] =
            standardError(total, valueOf(pixel + totalSquares, channel), pixel[totalBatch + channel], n);
    }
}

void developBias(const float* bias, size_t first, const BiasCounts& n, FilmImage& image) {
    const float* ofTotal = bias + size_t(9) * LIGHT_CLASSES;
    for (size_t channel = 0; channel < 3; ++channel) {
        const size_t at = first + channel;
        double total = 0;
        for (size_t c = 0; c < LIGHT_CLASSES; ++c) {
            const float* sums = bias + 9 * c + channel;
            image.componentBias[c][at] = static_cast<float>(sums[0] / n.passes);
            image.componentBiasError[c][at] = biasStandardError(sums[0], sums[3], sums[6], n);
            total += sums[0];
        }
        image.bias[at] = static_cast<float>(total / n.passes);
        image.biasError[at] = biasStandardError(total, ofTotal[channel], ofTotal[3 + channel], n);
    }
}

// Zero everywhere: no such light, or no such error.
bool isBlack(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return v == 0; });
}

} // namespace

size_t Film::floatsPerPixel(bool estimatesBias) { return filmLayout::floatsPerPixel(estimatesBias); }

Film::Film(Device& device, unsigned width, unsigned height, bool estimatesBias, const std::string& owner)
    : width_(width), height_(height), estimatesBias_(estimatesBias), pixelFloats_(floatsPerPixel(estimatesBias)),
      sums_(device, pixelFloats_ * width * height, owner + "film"), counters_(device, 1, owner + "camera counters") {
    sums_.fill(0);
    counters_.write({shared::CameraCounters{0, 0, 0}});
}

Film::Pass Film::beginPass(unsigned pass) {
    isWhole_ = false;
    Pass now{0, 1};
    const bool single = pass < singlePasses;
    if (!single) now.biasWeight = pass % batchPasses == 1 || pass % batchPasses == 2 ? 2.f : 0.f;
    counts_.biasPasses += now.biasWeight;
    counts_.openBiasPasses += now.biasWeight;
    counts_.openPasses += 1;
    if (single || pass % batchPasses == batchPasses - 1) {
        now.batchWeight = static_cast<float>(1 / counts_.openPasses);
        counts_ = counts_.closed();
    }
    return now;
}

FilmImage Film::develop(unsigned passes) const {
    FilmImage image;
    developOver(image, passes);
    return image;
}

void Film::developOver(FilmImage& image, unsigned passes) const {
    const auto film = sums_.read();
    image.width = width_;
    image.height = height_;
    developSums(film, estimatesBias_, counts_, passes, image);
}

void developSums(const std::vector<float>& sums, bool estimatesBias, const FilmCounts& counts, unsigned passes,
                 FilmImage& image) {
    image.passes = passes;
    const size_t values = size_t(image.width) * image.height * 3;
    image.radiance.resize(values);
    image.standardError.resize(values);
    for (auto& component : image.components) component.resize(values);
    for (auto& error : image.componentError) error.resize(values);
    if (estimatesBias) {
        image.bias.resize(values);
        image.biasError.resize(values);
        for (auto& bias : image.componentBias) bias.resize(values);
        for (auto& error : image.componentBiasError) error.resize(values);
    }
    const FilmCounts closed = counts.closed();
    const Counts means{double(std::max(1u, passes)), closed.batches, counts.openWeight()};
    const BiasCounts biasCounts{std::max(1.0, counts.biasPasses), closed.biasSquares};
    const size_t pixelFloats = floatsPerPixel(estimatesBias);
    for (size_t pixel = 0; pixel < values / 3; ++pixel) {
        const float* ofPixel = sums.data() + pixel * pixelFloats;
        developPixel(ofPixel, pixel * 3, means, image);
        if (estimatesBias) developBias(ofPixel + biasSums, pixel * 3, biasCounts, image);
    }
    for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
        if (!isBlack(image.components[k])) continue;
        image.components[k].clear();
        if (k >= LIGHT_CLASSES) continue;
        image.componentError[k].clear();
        image.componentBias[k].clear();
        image.componentBiasError[k].clear();
    }
}

void Film::save(StateSink& sink, const std::string& name) const {
    sink.record(name + " counts", counts_);
    sink.array(name + " counters", counters_.read());
    sink.begin(name);
    for (size_t first = 0; first < sums_.size(); first += valuesAtOnce) {
        const auto part = sums_.read(first, std::min(valuesAtOnce, sums_.size() - first));
        sink.write(part.data(), part.size() * sizeof(float));
    }
}

void Film::restore(const StateSource& source, const std::string& name) {
    source.requireBytes(name, sums_.size() * sizeof(float));
    counts_ = source.record<FilmCounts>(name + " counts");
    counters_.write({source.record<shared::CameraCounters>(name + " counters")});
    std::vector<float> part;
    for (size_t first = 0; first < sums_.size(); first += valuesAtOnce) {
        part.resize(std::min(valuesAtOnce, sums_.size() - first));
        source.read(name, first * sizeof(float), part.data(), part.size() * sizeof(float));
        sums_.writeAt(first, part);
    }
}

} // namespace quasilux
