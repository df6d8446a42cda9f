// How far an image is from the truth, from its own passes: noise and the bias of the density radius
// (docs/method/accuracy.md).
#pragma once

#include "render/film_image.h"

#include <cmath>

namespace quasilux {

/// Of one component, or of the whole image. The relative error of a pixel is the root mean square over R, G, B of
/// error / sqrt(value^2 + 0.01 m^2), with the value of the whole image in the 3 x 3 pixels about it and m its mean: the
/// weight of relMSE, free of the pixel's own noise.
struct ErrorPart {
    double noiseMean = 0;         ///< standard error, mean over pixels; corrected for the few passes it comes from
    double noisePercentile95 = 0; ///< its 95th percentile over pixels, corrected likewise
    double noiseRms = 0;          ///< its root mean square over pixels; its square is unbiased for any number of passes
    double biasRms = 0;           ///< of the density radius, root mean square over pixels, net of the estimate's noise
    double biasNoiseRms = 0;      ///< that noise: what the bias of a single pixel is known to
};

/// All infinite where fewer than two batches of passes give no estimate; all 0 for a black image.
struct ErrorEstimate {
    ErrorPart total;
    std::array<ErrorPart, LIGHT_CLASSES> components; ///< by LIGHT_*; zeros where the image has no such light
    bool hasBias = false;                            ///< or else the bias was not estimated and its figures are 0

    /// What `--error` is compared with: the mean noise plus the bias.
    double sum() const { return total.noiseMean + total.biasRms; }
    bool isKnown() const { return std::isfinite(sum()); }
    /// Estimate of relMSE, the mean over pixels and channels of (I - truth)^2 / (I^2 + 0.01 m^2).
    double relativeMse() const { return total.noiseRms * total.noiseRms + total.biasRms * total.biasRms; }
};

ErrorEstimate estimateError(const FilmImage& image);

/// Squares of noise and bias, the latter net of its noise, by tile of the image: the tiles' sums are noiseRms^2 and,
/// where that is above 0, biasRms^2.
struct TileErrors {
    std::vector<double> noise, bias;
};
/// `perSide` tiles in a row and in a column, fewer where the image has fewer pixels. `brightness`: radiance of an image
/// of the same scene that is less noisy, what errors are relative to; empty: that of `image`.
TileErrors errorByTile(const FilmImage& image, unsigned perSide, const std::vector<float>& brightness = {});

/// relMSE of the noise, at most, with which one camera path a pixel finds the light of `component` by meeting emitters
/// of this mean radiance. What a path brings is the emitter's radiance times a throughput of at most 1, so the mean of
/// its square is at most the pixel's light times the radiance.
double noiseOfFinding(const FilmImage& image, unsigned component, double radiance,
                      const std::vector<float>& brightness = {});

} // namespace quasilux
