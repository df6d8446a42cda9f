#include "render/film.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

// Pixel positions are spread evenly over passes in a row, so batches estimate the variance of the mean with less bias;
// but of few passes single ones estimate it with less variance. Bias is estimated in the middle half of each batch of
// four, about whose middle the radii are even, and in all passes before: half the cost, and no change of its mean.
constexpr unsigned singlePasses = 16, batchPasses = 4;

// How often the film was added to.
struct Counts {
    double passes, batches;
    double openWeight; // 1 / passes of the open batch, 0 if there is none
};

// Pixels of which the sums are read at once.
constexpr size_t pixelsAtOnce = 1 << 16;

struct PlannedPart {
    size_t firstPixel, pixels;
    PlannedBuffer<float> sums;
};

std::vector<PlannedPart> partsOf(size_t pixels, const FilmLayout& layout, uint64_t largestBuffer,
                                 const std::string& owner) {
    const size_t floats = layout.floatsPerPixel();
    const size_t most = std::max<size_t>(largestBuffer / (floats * sizeof(float)) / 64, 1) * 64;
    std::vector<PlannedPart> parts;
    size_t first = 0;
    do {
        const size_t ofPart = std::min(most, pixels - first);
        const std::string number = parts.empty() ? "" : ' ' + std::to_string(parts.size() + 1);
        parts.push_back({first, ofPart, {owner + "film" + number, ofPart * floats}});
        first += ofPart;
    } while (first < pixels);
    return parts;
}

PlannedBuffer<shared::CameraCounters> countersOf(const std::string& owner) { return {owner + "camera counters", 1}; }

// Standard error of the mean from the sum over passes, the squares of batches, each divided by its number of passes,
// and the sum over the open batch.
float standardError(double sum, double squares, double open, const Counts& n) {
    if (n.batches < 2) return 0;
    const double all = squares + open * open * n.openWeight;
    return static_cast<float>(std::sqrt(std::max(0.0, all - sum * sum / n.passes) / (n.passes * (n.batches - 1))));
}

// The same of the bias, in the terms of its own passes.
struct BiasCounts {
    double passes, squares; // sums over batches of their passes and of the squares of their passes
};

// Standard error of the mean bias from the sum over passes and the squares of batches S_b of m_b passes. Its noise
// grows as discs shrink, and early passes make up more batches than late ones: divided by m_b, as those of the image
// are, the squares estimated 0.77 of its variance after 64 passes. For independent batches with one mean and any
// variances,
//     E [sum S_b^2 - q S^2] = (1 - q) Var S,    q = sum m_b^2 / n^2.
// The estimate has little variance as long as a pass's noise is not much less than its mean, which holds for the bias,
// but not for the image.
float biasStandardError(double sum, double squares, double open, const BiasCounts& n) {
    const double share = n.squares / (n.passes * n.passes);
    if (share >= 1) return 0;
    const double variance = std::max(0.0, squares + open * open - share * sum * sum) / (1 - share);
    return static_cast<float>(std::sqrt(variance) / n.passes);
}

// Where the sums of a pixel are, of the whole image or of one component. Null: there are none.
struct PixelSums {
    const float *radiance, *squares, *openBatch, *bias;
};

PixelSums totalSums(const float* pixel, const FilmLayout& layout) {
    return {pixel + FILM_TOTAL_SUM, pixel + FILM_TOTAL_SQUARES, pixel + FILM_TOTAL_BATCH,
            layout.bias ? pixel + FILM_TOTAL_BIAS : nullptr};
}

PixelSums componentSums(const float* pixel, const FilmLayout& layout, size_t k) {
    const unsigned bits = layout.bits();
    PixelSums sums{pixel + FILM_COMPONENT_SUMS(bits) + k * FILM_SUM_FLOATS, nullptr, nullptr, nullptr};
    if (k >= LIGHT_CLASSES) return sums;
    sums.squares = pixel + FILM_CLASS_SQUARES(bits) + k * FILM_SUM_FLOATS;
    sums.openBatch = pixel + FILM_CLASS_BATCH(bits) + 3 * k;
    if (layout.bias) sums.bias = pixel + FILM_CLASS_BIAS(bits) + k * FILM_BIAS_FLOATS;
    return sums;
}

void developPixel(const PixelSums& sums, size_t first, const Counts& n, const BiasCounts& ofBias,
                  RadianceEstimate& estimate) {
    for (size_t channel = 0; channel < 3; ++channel) {
        const size_t at = first + channel;
        const double sum = valueOfSum(sums.radiance, channel);
        estimate.radiance[at] = static_cast<float>(sum / n.passes);
        if (sums.squares)
            estimate.standardError[at] =
                standardError(sum, valueOfSum(sums.squares, channel), sums.openBatch[channel], n);
        if (!sums.bias) continue;
        const double bias = sums.bias[FILM_BIAS_SUM + channel];
        estimate.bias[at] = static_cast<float>(bias / ofBias.passes);
        estimate.biasError[at] = biasStandardError(bias, sums.bias[FILM_BIAS_SQUARES + channel],
                                                   sums.bias[FILM_BIAS_BATCH + channel], ofBias);
    }
}

// Zero everywhere: no such light, or no such error.
bool isBlack(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return v == 0; });
}

} // namespace

Film::Film(Device& device, unsigned width, unsigned height, FilmLayout layout, uint64_t largestBuffer,
           const std::string& owner)
    : width_(width), height_(height), layout_(layout), counters_(countersOf(owner).make(device)) {
    for (const PlannedPart& part : partsOf(pixels(), layout, largestBuffer, owner))
        parts_.push_back({part.firstPixel, part.pixels, part.sums.make(device)});
    clear();
}

void Film::clear() {
    for (Part& part : parts_) part.sums.fill(0);
    counters_.write({shared::CameraCounters{0, 0, 0}});
    counts_ = {};
    endPass();
}

BufferSizes Film::plan(size_t pixels, FilmLayout layout, uint64_t largestBuffer, const std::string& owner) {
    BufferSizes sizes = sizesOf(countersOf(owner));
    for (const PlannedPart& part : partsOf(pixels, layout, largestBuffer, owner)) sizes.merge(sizesOf(part.sums));
    return sizes;
}

Buffer<float>& Film::sums() {
    if (parts_.size() != 1) throw std::logic_error("a film in several parts has no buffer of all sums");
    return parts_.front().sums;
}

Film::Pass Film::beginPass(unsigned pass, PassPart part) {
    return part.isFirst() ? ofPart(countPass(pass), part) : ofPart(pass_, part);
}

Film::Pass Film::beginBatch(PassPart part) { return part.isFirst() ? ofPart(countBatch(), part) : ofPart(pass_, part); }

// A batch ends with the last part.
Film::Pass Film::ofPart(const Pass& last, PassPart part) {
    isWhole_ = false;
    pass_ = last;
    pass_.layout = layout_.bits() | (part.isWhole() ? 0 : FILM_IN_PARTS);
    return {part.isLast() ? last.batchWeight : 0, last.biasWeight, pass_.layout};
}

Film::Pass Film::countPass(unsigned pass) {
    if (pass < singlePasses) return countBatch();
    Pass now{0, pass % batchPasses == 1 || pass % batchPasses == 2 ? 2.f : 0.f};
    counts_.biasPasses += now.biasWeight;
    counts_.openBiasPasses += now.biasWeight;
    counts_.openPasses += 1;
    if (pass % batchPasses == batchPasses - 1) {
        now.batchWeight = static_cast<float>(1 / counts_.openPasses);
        counts_ = counts_.closed();
    }
    return now;
}

Film::Pass Film::countBatch() {
    counts_.biasPasses += 1;
    counts_.openBiasPasses += 1;
    counts_.openPasses += 1;
    const auto batchWeight = static_cast<float>(1 / counts_.openPasses);
    counts_ = counts_.closed();
    return {batchWeight, 1};
}

FilmImage Film::develop(unsigned passes) const {
    FilmImage image;
    developOver(image, passes);
    return image;
}

void Film::developOver(FilmImage& image, unsigned passes) const {
    image.width = width_;
    image.height = height_;
    FilmDeveloper developer(layout_, counts_, passes, image);
    forEachPiece([&](const std::vector<float>& sums, size_t first) {
        developer.develop(sums.data(), first, sums.size() / layout_.floatsPerPixel());
    });
    developer.finish();
}

void Film::forEachPiece(const std::function<void(const std::vector<float>& sums, size_t firstPixel)>& use) const {
    const size_t floats = layout_.floatsPerPixel();
    for (const Part& part : parts_)
        for (size_t first = 0; first < part.pixels; first += pixelsAtOnce)
            use(part.sums.read(first * floats, std::min(pixelsAtOnce, part.pixels - first) * floats),
                part.firstPixel + first);
}

FilmDeveloper::FilmDeveloper(const FilmLayout& layout, const FilmCounts& counts, unsigned passes, FilmImage& image)
    : layout_(layout), counts_(counts), passes_(passes), image_(image) {
    const size_t values = size_t(image.width) * image.height * 3;
    image.resize(values, true, layout.bias);
    if (!layout.components) return;
    for (size_t k = 0; k < FILM_COMPONENTS; ++k)
        image.components[k].resize(values, k < LIGHT_CLASSES, k < LIGHT_CLASSES && layout.bias);
}

void FilmDeveloper::develop(const float* sums, size_t firstPixel, size_t pixels) {
    const FilmCounts closed = counts_.closed();
    const Counts means{double(std::max(1u, passes_)), closed.batches, counts_.openWeight()};
    const BiasCounts biasCounts{std::max(1.0, counts_.biasPasses), closed.biasSquares};
    const size_t components = layout_.components ? FILM_COMPONENTS : 0;
    for (size_t k = 0; k < pixels; ++k) {
        const float* pixel = sums + k * layout_.floatsPerPixel();
        const size_t first = 3 * (firstPixel + k);
        developPixel(totalSums(pixel, layout_), first, means, biasCounts, image_);
        for (size_t c = 0; c < components; ++c)
            developPixel(componentSums(pixel, layout_, c), first, means, biasCounts, image_.components[c]);
    }
}

// Passes 19 and 20 alone estimate no bias; of 16 to 20 nobody knows how well they do.
bool FilmDeveloper::knowsBias() const {
    const FilmCounts closed = counts_.closed();
    return closed.biasPasses > 0 && (closed.batches < 2 || closed.biasSquares < closed.biasPasses * closed.biasPasses);
}

void FilmDeveloper::finish() {
    if (!knowsBias()) {
        image_.dropBias();
        for (RadianceEstimate& component : image_.components) component.dropBias();
    }
    image_.passes = passes_;
    image_.batches = static_cast<unsigned>(counts_.closed().batches);
    for (RadianceEstimate& component : image_.components)
        if (isBlack(component.radiance)) component.resize(0, false, false);
}

void Film::save(StateSink& sink, const std::string& name) const {
    sink.record(name + " counts", counts_);
    sink.array(name + " counters", counters_.read());
    sink.begin(name);
    forEachPiece([&](const std::vector<float>& sums, size_t) { sink.write(sums.data(), sums.size() * sizeof(float)); });
}

void Film::restore(const StateSource& source, const std::string& name) {
    const size_t floats = layout_.floatsPerPixel();
    source.requireBytes(name, pixels() * floats * sizeof(float));
    counts_ = source.record<FilmCounts>(name + " counts");
    counters_.write({source.record<shared::CameraCounters>(name + " counters")});
    std::vector<float> sums;
    for (Part& part : parts_)
        for (size_t first = 0; first < part.pixels; first += pixelsAtOnce) {
            sums.resize(std::min(pixelsAtOnce, part.pixels - first) * floats);
            source.read(name, (part.firstPixel + first) * floats * sizeof(float), sums.data(),
                        sums.size() * sizeof(float));
            part.sums.writeAt(first * floats, sums);
        }
}

} // namespace quasilux
