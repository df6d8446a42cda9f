#include "render/film.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// Layout of kernels/film.clh: components, then the squares of their total; each R, G, B high parts, then low parts.
constexpr size_t sumFloats = 6;
constexpr size_t pixelFloats = (FILM_COMPONENTS + 1) * sumFloats;

double sumOf(const float* sum, size_t channel) { return double(sum[channel]) + sum[channel + 3]; }

// Standard error of the mean of n values from their sum and sum of squares.
double standardError(double sum, double squares, double n) {
    if (n < 2) return 0;
    return std::sqrt(std::max(0.0, squares - sum * sum / n) / (n * (n - 1)));
}

void developPixel(const float* pixel, size_t first, double passes, FilmImage& image) {
    for (size_t channel = 0; channel < 3; ++channel) {
        double total = 0;
        for (size_t k = 0; k < FILM_COMPONENTS; ++k) {
            const double sum = sumOf(pixel + k * sumFloats, channel);
            image.components[k][first + channel] = static_cast<float>(sum / passes);
            total += sum;
        }
        image.radiance[first + channel] = static_cast<float>(total / passes);
        const double squares = sumOf(pixel + FILM_COMPONENTS * sumFloats, channel);
        image.standardError[first + channel] = static_cast<float>(standardError(total, squares, passes));
    }
}

} // namespace

Film::Film(Device& device, unsigned width, unsigned height)
    : width_(width), height_(height), sums_(device, pixelFloats * width * height, "film"),
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
    const auto film = sums_.read();
    for (size_t pixel = 0; pixel < values / 3; ++pixel)
        developPixel(film.data() + pixel * pixelFloats, pixel * 3, std::max(1u, passes), image);
    for (auto& component : image.components)
        if (std::all_of(component.begin(), component.end(), [](float v) { return v == 0; })) component.clear();
    return image;
}

} // namespace quasilux
