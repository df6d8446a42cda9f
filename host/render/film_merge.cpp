#include "render/film_merge.h"

namespace quasilux {

namespace {

void setValue(float* sum, size_t channel, double value) {
    sum[channel] = static_cast<float>(value);
    sum[channel + 3] = static_cast<float>(value - sum[channel]);
}

/// One of the films of a pixel; `openWeight`: 1 / passes of the batch that is open, 0 where none is.
struct FilmPixel {
    const float* pixel;
    double openWeight;

    /// Of batches, that which is open as one of them.
    double squares(size_t at, size_t open, size_t channel) const {
        const double sum = pixel[open + channel];
        return valueOfSum(pixel + at, channel) + sum * sum * openWeight;
    }
    /// Those of the bias are plain and have no weights (film.cpp).
    double biasSquares(size_t at, size_t open, size_t channel) const {
        const double sum = pixel[open + channel];
        return pixel[at + channel] + sum * sum;
    }
};

void mergeSum(float* pixel, const FilmPixel& a, const FilmPixel& b, size_t at) {
    for (size_t channel = 0; channel < 3; ++channel)
        setValue(pixel + at, channel, valueOfSum(a.pixel + at, channel) + valueOfSum(b.pixel + at, channel));
}

void mergeSquares(float* pixel, const FilmPixel& a, const FilmPixel& b, size_t at, size_t open) {
    for (size_t channel = 0; channel < 3; ++channel) {
        setValue(pixel + at, channel, a.squares(at, open, channel) + b.squares(at, open, channel));
        pixel[open + channel] = 0;
    }
}

void mergeBias(float* pixel, const FilmPixel& a, const FilmPixel& b, size_t at) {
    const size_t sum = at + FILM_BIAS_SUM, squares = at + FILM_BIAS_SQUARES, open = at + FILM_BIAS_BATCH;
    for (size_t channel = 0; channel < 3; ++channel) {
        pixel[sum + channel] = a.pixel[sum + channel] + b.pixel[sum + channel];
        pixel[squares + channel] =
            static_cast<float>(a.biasSquares(squares, open, channel) + b.biasSquares(squares, open, channel));
        pixel[open + channel] = 0;
    }
}

void mergePixel(float* pixel, const FilmPixel& a, const FilmPixel& b, const FilmLayout& layout) {
    mergeSum(pixel, a, b, FILM_TOTAL_SUM);
    mergeSquares(pixel, a, b, FILM_TOTAL_SQUARES, FILM_TOTAL_BATCH);
    if (layout.bias) mergeBias(pixel, a, b, FILM_TOTAL_BIAS);
    if (!layout.components) return;
    const unsigned bits = layout.bits();
    for (size_t k = 0; k < FILM_COMPONENTS; ++k) mergeSum(pixel, a, b, FILM_COMPONENT_SUMS(bits) + k * FILM_SUM_FLOATS);
    for (size_t c = 0; c < LIGHT_CLASSES; ++c) {
        mergeSquares(pixel, a, b, FILM_CLASS_SQUARES(bits) + c * FILM_SUM_FLOATS, FILM_CLASS_BATCH(bits) + 3 * c);
        if (layout.bias) mergeBias(pixel, a, b, FILM_CLASS_BIAS(bits) + c * FILM_BIAS_FLOATS);
    }
}

} // namespace

void mergeFilmSums(float* sums, const FilmCounts& counts, const float* others, const FilmCounts& otherCounts,
                   size_t pixels, const FilmLayout& layout) {
    const size_t floats = layout.floatsPerPixel();
    for (size_t k = 0; k < pixels; ++k) {
        float* pixel = sums + k * floats;
        mergePixel(pixel, {pixel, counts.openWeight()}, {others + k * floats, otherCounts.openWeight()}, layout);
    }
}

void closeBatches(float* sums, const FilmCounts& counts, size_t pixels, const FilmLayout& layout) {
    const size_t floats = layout.floatsPerPixel();
    const std::vector<float> none(floats);
    for (size_t k = 0; k < pixels; ++k)
        mergePixel(sums + k * floats, {sums + k * floats, counts.openWeight()}, {none.data(), 0}, layout);
}

FilmCounts mergedCounts(const FilmCounts& a, const FilmCounts& b) {
    const FilmCounts first = a.closed(), second = b.closed();
    return {first.batches + second.batches, 0, first.biasPasses + second.biasPasses, 0,
            first.biasSquares + second.biasSquares};
}

} // namespace quasilux
