#include "render/film.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Layout of kernels/film.clh: compensated sums of the components, of the total's squares, of the squares of each class of
// light; with an estimate of the bias plain sums of it and of its squares by class, then of the squares of its total.
constexpr size_t sumFloats = 6;
constexpr size_t totalSquares = FILM_COMPONENTS * sumFloats;
constexpr size_t classSquares = totalSquares + sumFloats;
constexpr size_t biasSums = classSquares + LIGHT_CLASSES * sumFloats;
constexpr size_t biasFloats = LIGHT_CLASSES * 6 + 3;

double sumOf(const float* sum, size_t channel) { return double(sum[channel]) + sum[channel + 3]; }

// Standard error of the mean of n values from their sum and sum of squares.
float standardError(double sum, double squares, double n) {
    if (n < 2) return 0;
    return static_cast<float>(std::sqrt(std::max(0.0, squares - sum * sum / n) / (n * (n - 1))));
}

void developPixel(const float* pixel, size_t first, double passes, FilmImage& image) {
    for (size_t channel = 0; channel < 3; ++channel) {
        const size_t at = first + channel;
        double total = 0;
        for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
            const double sum = sumOf(pixel + k * sumFloats, channel);
            image.components[k][at] = static_cast<float>(sum / passes);
            total += sum;
            if (k >= LIGHT_CLASSES) continue;
            const double squares = sumOf(pixel + classSquares + k * sumFloats, channel);
            image.componentError[k][at] = standardError(sum, squares, passes);
        }
        image.radiance[at] = static_cast<float>(total / passes);
        image.standardError[at] = standardError(total, sumOf(pixel + totalSquares, channel), passes);
    }
}

void developBias(const float* bias, size_t first, double passes, FilmImage& image) {
    for (size_t channel = 0; channel < 3; ++channel) {
        const size_t at = first + channel;
        double total = 0;
        for (size_t c = 0; c < LIGHT_CLASSES; ++c) {
            const double sum = bias[6 * c + channel], squares = bias[6 * c + 3 + channel];
            image.componentBias[c][at] = static_cast<float>(sum / passes);
            image.componentBiasError[c][at] = standardError(sum, squares, passes);
            total += sum;
        }
        image.bias[at] = static_cast<float>(total / passes);
        image.biasError[at] = standardError(total, bias[LIGHT_CLASSES * 6 + channel], passes);
    }
}

// Zero everywhere: no such light, or no such error.
bool isBlack(const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float v) { return v == 0; });
}

} // namespace

Film::Film(Device& device, unsigned width, unsigned height, bool estimatesBias)
    : width_(width), height_(height), estimatesBias_(estimatesBias),
      pixelFloats_(biasSums + (estimatesBias ? biasFloats : 0)), sums_(device, pixelFloats_ * width * height, "film"),
      counters_(device, 1, "camera counters") {
    sums_.fill(0);
    counters_.write({shared::CameraCounters{0, 0, 0}});
}

FilmImage Film::develop(unsigned passes) const {
    FilmImage image;
    image.width = width_;
    image.height = height_;
    image.passes = passes;
    const size_t values = size_t(image.width) * image.height * 3;
    image.radiance.resize(values);
    image.standardError.resize(values);
    for (auto& component : image.components) component.resize(values);
    for (auto& error : image.componentError) error.resize(values);
    if (estimatesBias_) {
        image.bias.resize(values);
        image.biasError.resize(values);
        for (auto& bias : image.componentBias) bias.resize(values);
        for (auto& error : image.componentBiasError) error.resize(values);
    }
    const auto film = sums_.read();
    const double n = std::max(1u, passes);
    for (size_t pixel = 0; pixel < values / 3; ++pixel) {
        const float* sums = film.data() + pixel * pixelFloats_;
        developPixel(sums, pixel * 3, n, image);
        if (estimatesBias_) developBias(sums + biasSums, pixel * 3, n, image);
    }
    for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
        if (!isBlack(image.components[k])) continue;
        image.components[k].clear();
        if (k >= LIGHT_CLASSES) continue;
        image.componentError[k].clear();
        image.componentBias[k].clear();
        image.componentBiasError[k].clear();
    }
    return image;
}

} // namespace quasilux
