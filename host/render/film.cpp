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

std::string partLabel(const std::string& owner, size_t part) {
    return owner + "film" + (part > 0 ? ' ' + std::to_string(part + 1) : "");
}

// Pixels of each part.
std::vector<size_t> partsOf(size_t pixels, const FilmLayout& layout, uint64_t largestBuffer) {
    const size_t most = std::max<size_t>(largestBuffer / (layout.floatsPerPixel() * sizeof(float)) / 64, 1) * 64;
    std::vector<size_t> parts;
    do {
        parts.push_back(std::min(most, pixels));
        pixels -= parts.back();
    } while (pixels > 0);
    return parts;
}

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

void developPixel(const float* pixel, size_t first, const Counts& n, FilmImage& image) {
    for (size_t channel = 0; channel < 3; ++channel) {
        const double sum = valueOfSum(pixel + FILM_TOTAL_SUM, channel);
        image.radiance[first + channel] = static_cast<float>(sum / n.passes);
        image.standardError[first + channel] =
            standardError(sum, valueOfSum(pixel + FILM_TOTAL_SQUARES, channel), pixel[FILM_TOTAL_BATCH + channel], n);
    }
}

void developComponents(const float* pixel, unsigned layout, size_t first, const Counts& n, FilmImage& image) {
    const float *sums = pixel + FILM_COMPONENT_SUMS(layout), *squares = pixel + FILM_CLASS_SQUARES(layout),
                *open = pixel + FILM_CLASS_BATCH(layout);
    for (size_t channel = 0; channel < 3; ++channel)
        for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
            const double sum = valueOfSum(sums + k * FILM_SUM_FLOATS, channel);
            image.components[k][first + channel] = static_cast<float>(sum / n.passes);
            if (k < LIGHT_CLASSES)
                image.componentError[k][first + channel] =
                    standardError(sum, valueOfSum(squares + k * FILM_SUM_FLOATS, channel), open[3 * k + channel], n);
        }
}

void developBias(const float* sums, size_t first, const BiasCounts& n, std::vector<float>& bias,
                 std::vector<float>& error) {
    for (size_t channel = 0; channel < 3; ++channel) {
        const double sum = sums[FILM_BIAS_SUM + channel];
        bias[first + channel] = static_cast<float>(sum / n.passes);
        error[first + channel] =
            biasStandardError(sum, sums[FILM_BIAS_SQUARES + channel], sums[FILM_BIAS_BATCH + channel], n);
    }
}

// Zero everywhere: no such light, or no such error.
bool isBlack(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return v == 0; });
}

} // namespace

Film::Film(Device& device, unsigned width, unsigned height, FilmLayout layout, uint64_t largestBuffer,
           const std::string& owner)
    : width_(width), height_(height), layout_(layout), counters_(device, 1, owner + "camera counters") {
    size_t first = 0;
    for (const size_t pixels : partsOf(size_t(width) * height, layout, largestBuffer)) {
        parts_.push_back(
            {first, pixels, Buffer<float>(device, pixels * layout.floatsPerPixel(), partLabel(owner, parts_.size()))});
        first += pixels;
    }
    clear();
}

void Film::clear() {
    for (Part& part : parts_) part.sums.fill(0);
    counters_.write({shared::CameraCounters{0, 0, 0}});
    counts_ = {};
    endPass();
}

std::map<std::string, uint64_t> Film::plan(size_t pixels, FilmLayout layout, uint64_t largestBuffer,
                                           const std::string& owner) {
    std::map<std::string, uint64_t> bytes{{owner + "camera counters", sizeof(shared::CameraCounters)}};
    size_t part = 0;
    for (const size_t ofPart : partsOf(pixels, layout, largestBuffer))
        bytes[partLabel(owner, part++)] = ofPart * layout.floatsPerPixel() * sizeof(float);
    return bytes;
}

Buffer<float>& Film::sums() {
    if (parts_.size() != 1) throw std::logic_error("a film in several parts has no buffer of all sums");
    return parts_.front().sums;
}

Film::Pass Film::beginPass(unsigned pass) {
    if (pass < singlePasses) return beginBatch();
    isWhole_ = false;
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

Film::Pass Film::beginBatch() {
    isWhole_ = false;
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
    image.radiance.resize(values);
    image.standardError.resize(values);
    if (layout.bias) {
        image.bias.resize(values);
        image.biasError.resize(values);
    }
    if (!layout.components) return;
    for (auto& component : image.components) component.resize(values);
    for (auto& error : image.componentError) error.resize(values);
    if (!layout.bias) return;
    for (auto& bias : image.componentBias) bias.resize(values);
    for (auto& error : image.componentBiasError) error.resize(values);
}

void FilmDeveloper::develop(const float* sums, size_t firstPixel, size_t pixels) {
    const FilmCounts closed = counts_.closed();
    const Counts means{double(std::max(1u, passes_)), closed.batches, counts_.openWeight()};
    const BiasCounts biasCounts{std::max(1.0, counts_.biasPasses), closed.biasSquares};
    const unsigned layout = layout_.bits();
    for (size_t k = 0; k < pixels; ++k) {
        const float* pixel = sums + k * layout_.floatsPerPixel();
        const size_t first = 3 * (firstPixel + k);
        developPixel(pixel, first, means, image_);
        if (layout_.components) developComponents(pixel, layout, first, means, image_);
        if (!layout_.bias) continue;
        developBias(pixel + FILM_TOTAL_BIAS, first, biasCounts, image_.bias, image_.biasError);
        for (size_t c = 0; layout_.components && c < LIGHT_CLASSES; ++c)
            developBias(pixel + FILM_CLASS_BIAS(layout) + c * FILM_BIAS_FLOATS, first, biasCounts,
                        image_.componentBias[c], image_.componentBiasError[c]);
    }
}

void FilmDeveloper::finish() {
    image_.passes = passes_;
    for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
        if (!isBlack(image_.components[k])) continue;
        image_.components[k].clear();
        if (k >= LIGHT_CLASSES) continue;
        image_.componentError[k].clear();
        image_.componentBias[k].clear();
        image_.componentBiasError[k].clear();
    }
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
