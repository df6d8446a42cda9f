#include "render/film_merge.h"

#include "render/film_layout.h"

namespace quasilux {

namespace {

using namespace filmLayout;

void setValue(float* sum, size_t channel, double value) {
    sum[channel] = static_cast<float>(value);
    sum[channel + 3] = static_cast<float>(value - sum[channel]);
}

/// One of the films of a pixel; `openWeight`: 1 / passes of the batch that is open, 0 where none is.
struct Part {
    const float* pixel;
    double openWeight;

    /// Of batches, that which is open as one of them.
    double squares(size_t at, size_t open, size_t channel) const {
        const double sum = pixel[open + channel];
        return valueOf(pixel + at, channel) + sum * sum * openWeight;
    }
    /// Those of the bias are plain and have no weights (film.cpp).
    double biasSquares(size_t at, size_t open, size_t channel) const {
        const double sum = pixel[open + channel];
        return pixel[at + channel] + sum * sum;
    }
};

void mergeImage(float* pixel, const Part& a, const Part& b) {
    for (size_t channel = 0; channel < 3; ++channel) {
        setValue(pixel + totalSquares, channel,
                 a.squares(totalSquares, totalBatch, channel) + b.squares(totalSquares, totalBatch, channel));
        pixel[totalBatch + channel] = 0;
        for (size_t c = 0; c < LIGHT_CLASSES; ++c) {
            const size_t at = classSquares + c * sumFloats, open = classBatch + 3 * c;
            setValue(pixel + at, channel, a.squares(at, open, channel) + b.squares(at, open, channel));
            pixel[open + channel] = 0;
        }
        for (size_t k = 0; k < FILM_COMPONENTS; ++k)
            setValue(pixel + k * sumFloats, channel,
                     valueOf(a.pixel + k * sumFloats, channel) + valueOf(b.pixel + k * sumFloats, channel));
    }
}

void mergeBias(float* pixel, const Part& a, const Part& b) {
    const auto mergeSquares = [&](size_t at, size_t open) {
        for (size_t channel = 0; channel < 3; ++channel) {
            pixel[at + channel] =
                static_cast<float>(a.biasSquares(at, open, channel) + b.biasSquares(at, open, channel));
            pixel[open + channel] = 0;
        }
    };
    for (size_t c = 0; c < LIGHT_CLASSES; ++c) {
        const size_t sums = biasSums + c * biasClassFloats;
        for (size_t k = sums; k < sums + 3; ++k) pixel[k] = a.pixel[k] + b.pixel[k];
        mergeSquares(sums + 3, sums + 6);
    }
    const size_t total = biasSums + LIGHT_CLASSES * biasClassFloats;
    mergeSquares(total, total + 3);
}

} // namespace

void mergeFilmSums(float* sums, const FilmCounts& counts, const float* others, const FilmCounts& otherCounts,
                   size_t pixels, bool estimatesBias) {
    const size_t floats = floatsPerPixel(estimatesBias);
    for (size_t k = 0; k < pixels; ++k) {
        float* pixel = sums + k * floats;
        const Part a{pixel, counts.openWeight()}, b{others + k * floats, otherCounts.openWeight()};
        mergeImage(pixel, a, b);
        if (estimatesBias) mergeBias(pixel, a, b);
    }
}

FilmCounts mergedCounts(const FilmCounts& a, const FilmCounts& b) {
    const FilmCounts first = a.closed(), second = b.closed();
    return {first.batches + second.batches, 0, first.biasPasses + second.biasPasses, 0,
            first.biasSquares + second.biasSquares};
}

} // namespace quasilux
