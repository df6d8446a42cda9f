// Component names; images of several sets of passes as one.
#include "render/film_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

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

namespace {

std::vector<float> weightedMean(const std::vector<float>& a, double weightA, const std::vector<float>& b,
                                double weightB) {
    std::vector<float> mean(std::max(a.size(), b.size())); // a component without light is empty: zero
    for (size_t k = 0; k < mean.size(); ++k)
        mean[k] = static_cast<float>((a.empty() ? 0 : weightA * a[k]) + (b.empty() ? 0 : weightB * b[k]));
    return mean;
}

// Means over passes and their standard errors; both empty are zero.
struct MeanAndError {
    const std::vector<float>&mean, &error;
    double passes;

    double meanAt(size_t k) const { return mean.empty() ? 0 : mean[k]; }
    // Sum of squares of the passes from their mean and its standard error: n (n - 1) s^2 + n m^2.
    double squaresAt(size_t k) const {
        const double s = error.empty() ? 0 : error[k];
        return passes * (passes - 1) * s * s + passes * meanAt(k) * meanAt(k);
    }
};

std::vector<float> mergedError(const MeanAndError& a, const MeanAndError& b) {
    const double n = a.passes + b.passes;
    std::vector<float> merged(std::max(a.mean.size(), b.mean.size()));
    for (size_t k = 0; k < merged.size(); ++k) {
        const double mean = (a.passes * a.meanAt(k) + b.passes * b.meanAt(k)) / n;
        const double squares = a.squaresAt(k) + b.squaresAt(k);
        merged[k] = static_cast<float>(std::sqrt(std::max(0.0, squares - n * mean * mean) / (n * (n - 1))));
    }
    return merged;
}

} // namespace

FilmImage mergePasses(const FilmImage& a, const FilmImage& b) {
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument("images of different sizes cannot be merged");
    FilmImage merged = a;
    merged.passes = a.passes + b.passes;
    const double n = merged.passes, weightA = a.passes / n, weightB = b.passes / n;
    const auto merge = [&](std::vector<float> FilmImage::*mean, std::vector<float> FilmImage::*error) {
        merged.*mean = weightedMean(a.*mean, weightA, b.*mean, weightB);
        merged.*error = mergedError({a.*mean, a.*error, double(a.passes)}, {b.*mean, b.*error, double(b.passes)});
    };
    merge(&FilmImage::radiance, &FilmImage::standardError);
    if (a.bias.empty() == b.bias.empty()) // or else it is not known of the whole
        merge(&FilmImage::bias, &FilmImage::biasError);
    for (size_t k = 0; k < FILM_COMPONENTS; ++k)
        merged.components[k] = weightedMean(a.components[k], weightA, b.components[k], weightB);
    for (size_t k = 0; k < LIGHT_CLASSES; ++k) {
        merged.componentError[k] = mergedError({a.components[k], a.componentError[k], double(a.passes)},
                                               {b.components[k], b.componentError[k], double(b.passes)});
        merged.componentBias[k] = weightedMean(a.componentBias[k], weightA, b.componentBias[k], weightB);
        merged.componentBiasError[k] = mergedError({a.componentBias[k], a.componentBiasError[k], double(a.passes)},
                                                   {b.componentBias[k], b.componentBiasError[k], double(b.passes)});
    }
    return merged;
}

} // namespace quasilux
