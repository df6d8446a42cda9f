// Component names and error summaries of a developed film.
#include "render/film_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace quasilux {

namespace {

/// Luminance of linear sRGB (ITU-R BT.709). For standard errors it is an upper bound of the error of the luminance,
/// reached where the channels rise and fall together, as they do along one light path.
double luminanceAt(const std::vector<float>& rgb, size_t pixel) {
    return 0.2126 * rgb[3 * pixel] + 0.7152 * rgb[3 * pixel + 1] + 0.0722 * rgb[3 * pixel + 2];
}

} // namespace

std::string componentName(unsigned component) {
    switch (component) {
    case LIGHT_DIRECT:
        return "direct";
    case LIGHT_CAUSTIC:
        return "caustic";
    case LIGHT_QUASI_CAUSTIC:
        return "quasi_caustic";
    case LIGHT_DIFFUSE:
        return "diffuse";
    case FILM_EMISSION:
        return "emission";
    default:
        throw std::out_of_range("film component " + std::to_string(component) + " does not exist");
    }
}

RelativeError relativeError(const FilmImage& image) {
    const size_t pixels = image.radiance.size() / 3;
    if (image.passes < 2 || pixels == 0 || image.standardError.size() != image.radiance.size())
        return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

    double luminanceSum = 0;
    for (size_t i = 0; i < pixels; ++i) luminanceSum += luminanceAt(image.radiance, i);
    const double floor = 0.01 * luminanceSum / static_cast<double>(pixels);
    if (!(floor > 0)) return {0, 0}; // a black image: nothing arrived, so nothing varied

    std::vector<double> errors(pixels);
    double errorSum = 0;
    for (size_t i = 0; i < pixels; ++i) {
        errors[i] = luminanceAt(image.standardError, i) / std::max(luminanceAt(image.radiance, i), floor);
        errorSum += errors[i];
    }
    const size_t rank = static_cast<size_t>(std::ceil(0.95 * static_cast<double>(pixels))) - 1;
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank), errors.end());
    return {errorSum / static_cast<double>(pixels), errors[rank]};
}

namespace {

std::vector<float> weightedMean(const std::vector<float>& a, double weightA, const std::vector<float>& b,
                                double weightB) {
    std::vector<float> mean(std::max(a.size(), b.size())); // a component without light is empty: zero
    for (size_t k = 0; k < mean.size(); ++k)
        mean[k] = static_cast<float>((a.empty() ? 0 : weightA * a[k]) + (b.empty() ? 0 : weightB * b[k]));
    return mean;
}

// Sum of squares of the passes from their mean and its standard error: n (n - 1) s^2 + n m^2.
double sumOfSquares(double mean, double standardError, double n) {
    return n * (n - 1) * standardError * standardError + n * mean * mean;
}

} // namespace

FilmImage mergePasses(const FilmImage& a, const FilmImage& b) {
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("images of different sizes cannot be merged");
    FilmImage merged = a;
    merged.passes = a.passes + b.passes;
    const double n = merged.passes, weightA = a.passes / n, weightB = b.passes / n;
    merged.radiance = weightedMean(a.radiance, weightA, b.radiance, weightB);
    for (size_t k = 0; k < merged.components.size(); ++k)
        merged.components[k] = weightedMean(a.components[k], weightA, b.components[k], weightB);
    for (size_t k = 0; k < merged.standardError.size(); ++k) {
        const double squares = sumOfSquares(a.radiance[k], a.standardError[k], a.passes) +
                               sumOfSquares(b.radiance[k], b.standardError[k], b.passes);
        const double mean = weightA * a.radiance[k] + weightB * b.radiance[k];
        merged.standardError[k] =
            static_cast<float>(std::sqrt(std::max(0.0, squares - n * mean * mean) / (n * (n - 1))));
    }
    return merged;
}

double meanRelativeError(const FilmImage& image) { return relativeError(image).mean; }

} // namespace quasilux
