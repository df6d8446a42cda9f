// Sums over regions in double precision.
#include "compare/measures.h"

#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

constexpr std::array<double, 3> luminanceWeights{0.2126, 0.7152, 0.0722};
constexpr size_t tilesAcross = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool isFinite(const RadianceImage& image, size_t pixel) {
    const float* rgb = &image.radiance[3 * pixel];
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

double square(double x) { return x * x; }

/// The two images and what all regions share.
struct Pair {
    const RadianceImage& image;
    const RadianceImage& reference;
    const RadianceImage& denominator; ///< the reference, or what stands for it
    double floor = 0;                 ///< 0.01 mean(R)^2
    bool leaveOut = false;
    size_t tileSide = 1, tileColumns = 1;

    bool finite(size_t pixel) const { return isFinite(image, pixel) && isFinite(reference, pixel); }
    bool counts(size_t pixel) const { return !leaveOut || finite(pixel); }

    double difference(size_t i) const {
        return static_cast<double>(image.radiance[i]) - static_cast<double>(reference.radiance[i]);
    }
    /// A black reference has no scale: equal values then have no error.
    double scale(size_t i) const { return square(denominator.radiance[i]) + floor; }
    double relative(double squared, size_t i) const { return squared == 0 && scale(i) == 0 ? 0 : squared / scale(i); }
    double relativeSquare(size_t pixel) const {
        double sum = 0;
        for (size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) sum += relative(square(difference(i)), i);
        return sum / 3;
    }
    size_t tile(size_t pixel) const {
        return pixel / image.width / tileSide * tileColumns + pixel % image.width / tileSide;
    }
};

/// mean(R) over the pixels that count: one that is not finite makes every relMSE not finite, since mean(R) is in all.
double meanDenominator(const Pair& pair) {
    double sum = 0;
    size_t count = 0;
    for (size_t pixel = 0; pixel < pair.image.pixels(); ++pixel) {
        if (!pair.counts(pixel)) continue;
        for (size_t c = 0; c < 3; ++c) sum += pair.denominator.radiance[3 * pixel + c];
        count += 3;
    }
    const double mean = sum / static_cast<double>(count);
    return std::isfinite(mean) ? mean : std::nan(""); // an infinite floor would make every error 0
}

/// Mean over pixels and channels of value(i).
template <typename Value>
double meanOver(const std::vector<size_t>& pixels, const Value& value) {
    double sum = 0;
    for (const size_t pixel : pixels)
        for (size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) sum += value(i);
    return sum / static_cast<double>(3 * pixels.size());
}

/// Share of an image's noise in relMSE.
std::optional<double> noiseShare(const Pair& pair, const std::vector<float>& standardError,
                                 const std::vector<size_t>& pixels) {
    if (standardError.empty()) return std::nullopt;
    return meanOver(pixels, [&](size_t i) { return pair.relative(square(standardError[i]), i); });
}

/// Expectation of ((I - R)^2 - sigma^2) / (R^2 + floor) where I is right and R normal about it, to the fourth order in
/// sigma: 2 sigma^4 / s^2 (4 R^2 / s - 1), s = R^2 + floor, which is 6 (sigma / R)^4 where the floor is small.
std::optional<double> denominatorNoise(const Pair& pair, const std::vector<size_t>& pixels) {
    const auto& sigma = pair.reference.standardError;
    if (sigma.empty() || &pair.denominator != &pair.reference) return std::nullopt;
    return meanOver(pixels, [&](size_t i) {
        const double share = pair.relative(square(sigma[i]), i);
        return 2 * square(share) * (4 * pair.relative(square(pair.reference.radiance[i]), i) - 1);
    });
}

/// Standard error of the mean difference, of pixels independent of each other. Channels of a pixel come from the same
/// paths: their errors are added as if they were the same.
std::optional<double> errorByPixels(const Pair& pair, const std::vector<size_t>& pixels) {
    double sum = 0;
    bool known = false;
    for (const auto* image : {&pair.image, &pair.reference}) {
        if (image->standardError.empty()) continue;
        known = true;
        for (const size_t pixel : pixels) sum += square(luminance(&image->standardError[3 * pixel]));
    }
    return known ? std::optional(std::sqrt(sum) / static_cast<double>(pixels.size())) : std::nullopt;
}

/// Cluster-robust standard error of a mean (Liang & Zeger 1986, Longitudinal data analysis using generalized linear
/// models, with the correction K / (K - 1) for K clusters); clusters are the tiles.
std::optional<double> errorByTiles(const Pair& pair, const std::vector<size_t>& pixels, double mean) {
    std::map<size_t, double> excess; ///< by tile
    for (const size_t pixel : pixels)
        excess[pair.tile(pixel)] +=
            luminance(&pair.image.radiance[3 * pixel]) - luminance(&pair.reference.radiance[3 * pixel]) - mean;
    const auto count = static_cast<double>(excess.size());
    if (count < 2) return std::nullopt;
    double sum = 0;
    for (const auto& [tile, value] : excess) sum += square(value);
    return std::sqrt(sum * count / (count - 1)) / static_cast<double>(pixels.size());
}

double dot(const std::array<double, 3>& rgb) {
    return luminanceWeights[0] * rgb[0] + luminanceWeights[1] * rgb[1] + luminanceWeights[2] * rgb[2];
}

std::array<double, 3> meanOf(const RadianceImage& image, const std::vector<size_t>& pixels) {
    std::array<double, 3> sum{};
    for (const size_t pixel : pixels)
        for (size_t c = 0; c < 3; ++c) sum[c] += image.radiance[3 * pixel + c];
    for (double& value : sum) value /= static_cast<double>(pixels.size());
    return sum;
}

std::optional<double> statedNoise(const CompareSettings& settings, const std::string& region) {
    auto found = settings.referenceNoise.find(region);
    if (found == settings.referenceNoise.end()) found = settings.referenceNoise.find("");
    return found == settings.referenceNoise.end() ? std::nullopt : std::optional(found->second);
}

RegionMeasures measure(const Pair& pair, const Region& region, const CompareSettings& settings) {
    RegionMeasures result;
    result.name = region.name;
    result.pixels = region.pixels.size();
    std::vector<size_t> pixels;
    for (const size_t pixel : region.pixels) {
        if (!pair.finite(pixel)) ++result.nonFinite;
        if (pair.counts(pixel)) pixels.push_back(pixel);
    }
    // No pixels make every mean not a number.
    result.relMse = meanOver(pixels, [&](size_t i) { return pair.relative(square(pair.difference(i)), i); });
    result.rmse = std::sqrt(meanOver(pixels, [&](size_t i) { return square(pair.difference(i)); }));
    result.referenceNoise = noiseShare(pair, pair.reference.standardError, pixels);
    if (!result.referenceNoise) result.referenceNoise = statedNoise(settings, region.name);
    result.imageNoise = noiseShare(pair, pair.image.standardError, pixels);
    result.netRelMse = result.relMse - result.referenceNoise.value_or(0) -
                       (settings.netOfImageNoise ? result.imageNoise.value_or(0) : 0);
    result.denominatorNoise = denominatorNoise(pair, pixels);
    result.meanImage = meanOf(pair.image, pixels);
    result.meanReference = meanOf(pair.reference, pixels);
    result.meanLuminance = dot(result.meanImage);
    result.referenceLuminance = dot(result.meanReference);
    result.bias = result.meanLuminance - result.referenceLuminance;
    result.standardErrorByPixels = errorByPixels(pair, pixels);
    result.standardErrorByTiles = errorByTiles(pair, pixels, result.bias);
    return result;
}

WorstPixel describe(const Pair& pair, size_t pixel, double relativeSquare) {
    WorstPixel worst{pixel % pair.image.width, pixel / pair.image.width, {}, {}, relativeSquare, std::nullopt};
    std::copy_n(&pair.image.radiance[3 * pixel], 3, worst.image.begin());
    std::copy_n(&pair.reference.radiance[3 * pixel], 3, worst.reference.begin());
    for (size_t i = 3 * pixel; i < 3 * pixel + 3 && pair.finite(pixel); ++i) {
        const auto error = errorInStandardErrors(pair.image, pair.reference, i);
        if (error && (!worst.standardErrors || std::abs(*error) > std::abs(*worst.standardErrors)))
            worst.standardErrors = error;
    }
    return worst;
}

std::vector<WorstPixel> findWorst(const Pair& pair, const std::vector<double>& relativeSquares, size_t wanted) {
    std::vector<size_t> order(relativeSquares.size());
    for (size_t i = 0; i < order.size(); ++i) order[i] = i;
    const size_t count = std::min(wanted, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(), [&](size_t a, size_t b) {
            return relativeSquares[a] != relativeSquares[b] ? relativeSquares[a] > relativeSquares[b] : a < b;
        });
    std::vector<WorstPixel> worst;
    for (size_t i = 0; i < count; ++i) worst.push_back(describe(pair, order[i], relativeSquares[order[i]]));
    return worst;
}

std::optional<double> shareBeyondThree(const Pair& pair) {
    if (pair.image.standardError.empty() && pair.reference.standardError.empty()) return std::nullopt;
    size_t beyond = 0, all = 0;
    for (size_t i = 0; i < pair.image.radiance.size(); ++i) {
        if (!pair.counts(i / 3)) continue;
        ++all;
        const auto error = errorInStandardErrors(pair.image, pair.reference, i);
        if (!(std::abs(error.value_or(0)) <= 3)) ++beyond; // what is not finite is beyond
    }
    if (all == 0) return std::nullopt;
    return static_cast<double>(beyond) / static_cast<double>(all);
}

} // namespace

double luminance(const float* rgb) {
    return luminanceWeights[0] * rgb[0] + luminanceWeights[1] * rgb[1] + luminanceWeights[2] * rgb[2];
}

void checkReferenceNoise(const std::string& what, const std::string& region, double noise,
                         const std::vector<Region>& regions) {
    if (!(noise >= 0) || !std::isfinite(noise))
        throw InputError(fmt::format("{}: {} given, expected a number from 0", what, noise));
    const bool isKnown = region.empty() || std::any_of(regions.begin(), regions.end(),
                                                       [&](const Region& one) { return one.name == region; });
    if (!isKnown) throw InputError(fmt::format("{}: no region is called '{}'", what, region));
}

std::optional<double> RegionMeasures::standardError() const {
    if (!standardErrorByPixels || !standardErrorByTiles)
        return standardErrorByPixels ? standardErrorByPixels : standardErrorByTiles;
    return std::max(*standardErrorByPixels, *standardErrorByTiles);
}

std::optional<double> errorInStandardErrors(const RadianceImage& image, const RadianceImage& reference, size_t i) {
    if (image.standardError.empty() && reference.standardError.empty()) return std::nullopt;
    double variance = 0;
    for (const auto* side : {&image, &reference})
        if (!side->standardError.empty()) variance += square(side->standardError[i]);
    const double difference = static_cast<double>(image.radiance[i]) - static_cast<double>(reference.radiance[i]);
    return difference == 0 ? 0 : difference / std::sqrt(variance);
}

Comparison compareImages(const RadianceImage& image, const RadianceImage& reference, const std::vector<Region>& regions,
                         const CompareSettings& settings) {
    Pair pair{image, reference, settings.scale ? *settings.scale : reference};
    pair.tileSide = (std::max(image.width, image.height) + tilesAcross - 1) / tilesAcross;
    pair.tileColumns = (image.width + pair.tileSide - 1) / pair.tileSide;
    Comparison result;
    for (size_t pixel = 0; pixel < image.pixels(); ++pixel) {
        result.nonFiniteImage += !isFinite(image, pixel);
        result.nonFiniteReference += !isFinite(reference, pixel);
        if (!pair.finite(pixel)) result.nonFinitePixels.push_back(pixel);
    }
    const size_t nonFinite = result.nonFinitePixels.size();
    pair.leaveOut = result.nonFiniteLeftOut = nonFinite > 0 && nonFinite <= settings.maximumNonFinite;
    pair.floor = 0.01 * square(meanDenominator(pair));
    for (const auto& region : regions) result.regions.push_back(measure(pair, region, settings));
    for (size_t pixel = 0; pixel < image.pixels(); ++pixel)
        result.relativeSquares.push_back(pair.finite(pixel) ? pair.relativeSquare(pixel) : infinity);
    // mean(R) that is not finite leaves no order between pixels.
    for (double& value : result.relativeSquares)
        if (std::isnan(value)) value = infinity;
    result.worst = findWorst(pair, result.relativeSquares, settings.worstPixels);
    result.beyondThreeStandardErrors = shareBeyondThree(pair);
    return result;
}

} // namespace quasilux
