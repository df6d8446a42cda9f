#include "render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quasilux {

namespace {

// Mean of a channel over the 3 x 3 pixels about one, as far as they are in the image.
double meanAbout(const FilmImage& image, const std::vector<float>& radiance, size_t pixel, size_t channel) {
    const size_t x = pixel % image.width, y = pixel / image.width;
    double sum = 0, count = 0;
    for (size_t v = y > 0 ? y - 1 : 0; v <= y + 1 && v < image.height; ++v)
        for (size_t u = x > 0 ? x - 1 : 0; u <= x + 1 && u < image.width; ++u) {
            sum += radiance[3 * (v * image.width + u) + channel];
            count += 1;
        }
    return sum / count;
}

// 1 / sqrt(3 (value^2 + 0.01 m^2)) of each channel of each pixel: times an error, its share of the relative one; the
// squares of three channels add up. Not squared themselves: those of faint images leave the range of a float.
// After few passes a pixel that is too bright has a large standard error, too, and would divide it by too much: so the
// value is that of the neighbourhood.
std::vector<float> relativeScales(const FilmImage& image, const std::vector<float>& radiance) {
    double sum = 0;
    for (const float value : radiance) sum += value;
    const double mean = sum / static_cast<double>(radiance.size());
    std::vector<float> scales(radiance.size());
    for (size_t k = 0; k < scales.size(); ++k) {
        const double value = meanAbout(image, radiance, k / 3, k % 3), scale = value * value + 0.01 * mean * mean;
        scales[k] = scale > 0 ? static_cast<float>(1 / std::sqrt(3 * scale)) : 0;
    }
    return scales;
}

std::vector<double> squaredByPixel(const std::vector<float>& errors, const std::vector<float>& scales) {
    std::vector<double> squares(scales.size() / 3);
    for (size_t k = 0; k < errors.size(); ++k) {
        const double relative = double(scales[k]) * errors[k];
        squares[k / 3] += relative * relative;
    }
    return squares;
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

// Expected ratio of the standard deviation of a normal sample of n to the true one, c4.
double meanOfSampleDeviation(double n) {
    return std::sqrt(2 / (n - 1)) * std::exp(std::lgamma(n / 2) - std::lgamma((n - 1) / 2));
}

// Derivative of log gamma, and its derivative: recurrence, then the asymptotic series (Abramowitz & Stegun 6.3.18,
// 6.4.12).
double digamma(double x) {
    double sum = 0;
    while (x < 10) {
        sum -= 1 / x;
        ++x;
    }
    const double y = 1 / (x * x);
    return sum + std::log(x) - 1 / (2 * x) - y * (1.0 / 12 - y * (1.0 / 120 - y / 252));
}

double trigamma(double x) {
    double sum = 0;
    while (x < 10) {
        sum += 1 / (x * x);
        ++x;
    }
    const double y = 1 / (x * x);
    return sum + 1 / x + y / 2 + y / x * (1.0 / 6 - y * (1.0 / 30 - y / 42));
}

// 95th percentile of the true variances, given their estimates from n normal values each, of which the scatter of the
// estimates would make too much. Logarithms: log s^2 = log sigma^2 + log (chi^2 / nu), and mean and variance of the
// latter are known, so those of log sigma^2 follow and the estimates are drawn together to have them.
double percentile95(std::vector<double> variances, double n) {
    const size_t rank = static_cast<size_t>(std::ceil(0.95 * static_cast<double>(variances.size()))) - 1;
    std::nth_element(variances.begin(), variances.begin() + static_cast<std::ptrdiff_t>(rank), variances.end());
    const double found = variances[rank];
    if (!(found > 0)) return 0;
    double sum = 0, squares = 0, count = 0;
    for (const double variance : variances) {
        if (!(variance > 0)) continue;
        sum += std::log(variance);
        squares += std::log(variance) * std::log(variance);
        count += 1;
    }
    const double middle = sum / count, spread = squares / count - middle * middle;
    const double half = (n - 1) / 2, ofEstimates = trigamma(half);
    const double share = spread > ofEstimates ? std::sqrt(1 - ofEstimates / spread) : 0;
    // Estimates that scatter less than independent ones have their deviation in common, and it is not known.
    const double offset = (digamma(half) - std::log(half)) * std::min(1.0, spread / ofEstimates);
    return std::exp(middle - offset + share * (std::log(found) - middle));
}

ErrorPart partOf(const RadianceEstimate& estimate, const std::vector<float>& scales, double batches) {
    ErrorPart part;
    std::vector<double> squares = squaredByPixel(estimate.standardError, scales);
    part.noiseRms = std::sqrt(mean(squares));
    double roots = 0;
    for (const double square : squares) roots += std::sqrt(square);
    part.noiseMean = roots / static_cast<double>(squares.size()) / meanOfSampleDeviation(batches);
    part.noisePercentile95 = std::sqrt(percentile95(std::move(squares), batches));
    const double noiseOfBias = mean(squaredByPixel(estimate.biasError, scales));
    part.biasRms = std::sqrt(std::max(0.0, mean(squaredByPixel(estimate.bias, scales)) - noiseOfBias));
    part.biasNoiseRms = std::sqrt(noiseOfBias);
    return part;
}

ErrorPart unknownPart() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, infinity, infinity, infinity};
}

} // namespace

ErrorEstimate estimateError(const FilmImage& image) {
    ErrorEstimate estimate;
    estimate.hasBias = !image.bias.empty();
    if (!image.isErrorKnown() || image.standardError.size() != image.radiance.size()) {
        estimate.total = unknownPart();
        estimate.components.fill(unknownPart());
        return estimate;
    }
    const auto scales = relativeScales(image, image.radiance);
    estimate.total = partOf(image, scales, image.batches);
    for (size_t c = 0; c < LIGHT_CLASSES; ++c)
        if (!image.components[c].standardError.empty())
            estimate.components[c] = partOf(image.components[c], scales, image.batches);
    return estimate;
}

TileErrors errorByTile(const FilmImage& image, unsigned perSide, const std::vector<float>& brightness) {
    const auto scales = relativeScales(image, brightness.empty() ? image.radiance : brightness);
    const auto noise = squaredByPixel(image.standardError, scales);
    const auto bias = squaredByPixel(image.bias, scales), biasNoise = squaredByPixel(image.biasError, scales);
    const unsigned columns = std::min(perSide, image.width), rows = std::min(perSide, image.height);
    TileErrors tiles;
    tiles.noise.resize(size_t(columns) * rows);
    tiles.bias.resize(tiles.noise.size());
    const double share = 1 / static_cast<double>(noise.size());
    for (size_t pixel = 0; pixel < noise.size(); ++pixel) {
        const size_t column = pixel % image.width * columns / image.width;
        const size_t row = pixel / image.width * rows / image.height;
        tiles.noise[row * columns + column] += share * noise[pixel];
        tiles.bias[row * columns + column] += share * (bias[pixel] - biasNoise[pixel]);
    }
    return tiles;
}

double noiseOfFinding(const FilmImage& image, unsigned component, double radiance,
                      const std::vector<float>& brightness) {
    const auto& light = image.components.at(component).radiance;
    if (light.empty()) return 0;
    const auto scales = relativeScales(image, brightness.empty() ? image.radiance : brightness);
    double sum = 0;
    for (size_t k = 0; k < light.size(); ++k) sum += double(scales[k]) * scales[k] * light[k];
    return radiance * sum * 3 / static_cast<double>(light.size());
}

} // namespace quasilux
