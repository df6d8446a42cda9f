// How far an image is from a reference, region by region, and where most.
#pragma once

#include "compare/image_file.h"
#include "compare/regions.h"

#include <array>
#include <map>
#include <optional>

namespace quasilux {

struct CompareSettings {
    /// relMSE of the reference's noise where it has no standard errors: by region name, "" for those not named.
    std::map<std::string, double> referenceNoise = {};
    bool netOfImageNoise = false; ///< subtract the image's own noise too
    /// Stands for R in the denominators of relMSE, of the reference's size and finite; nullptr: the reference itself.
    const RadianceImage* scale = nullptr;
    size_t maximumNonFinite = 0; ///< up to so many pixels that are not finite are left out instead of spoiling sums
    size_t worstPixels = 5;
};

/// Throws InputError, which begins with `what`, unless `noise` may be that of the region's reference ("": of all).
void checkReferenceNoise(const std::string& what, const std::string& region, double noise,
                         const std::vector<Region>& regions);

/// Of one region. Radiance in the images' unit; luminance by ITU-R BT.709. What pixels that are not finite spoil is not
/// finite.
struct RegionMeasures {
    std::string name;
    size_t pixels = 0;
    size_t nonFinite = 0; ///< pixels with a channel that is not finite, in either image

    /// Mean over pixels and channels of (I - R)^2 / (R^2 + 0.01 mean(R)^2), mean(R) over channels and the whole
    /// picture.
    double relMse = 0;
    std::optional<double> referenceNoise, imageNoise; ///< expected share of relMse; nothing where unknown
    double netRelMse = 0;                             ///< relMse less what is known and was to be subtracted
    /// What the reference's noise adds to netRelMse through the denominators (docs/method/accuracy.md), which
    /// subtracting referenceNoise leaves. Nothing where the reference has no standard errors or CompareSettings::scale
    /// is given.
    std::optional<double> denominatorNoise;
    double rmse = 0; ///< over pixels and channels

    std::array<double, 3> meanImage{}, meanReference{}; ///< R, G, B
    double meanLuminance = 0, referenceLuminance = 0;
    double bias = 0; ///< meanLuminance - referenceLuminance
    /// Of `bias`. byPixels: from the standard errors of pixels as if these were independent of each other. byTiles:
    /// from how much the differences of tiles vary, tiles being squares of a quarter of the picture's longer side; it
    /// knows noise that neighbours share, as a photon's, and takes bias that varies for noise. Nothing where unknown.
    std::optional<double> standardErrorByPixels, standardErrorByTiles;

    double relativeBias() const { return bias == 0 ? 0 : bias / referenceLuminance; }
    /// The larger one of what is known.
    std::optional<double> standardError() const;
};

struct WorstPixel {
    size_t x = 0, y = 0; ///< from the top left, counted from 0
    std::array<float, 3> image{}, reference{};
    double relativeSquare = 0; ///< its share of relMSE: mean over channels; infinity where not finite
    /// (I - R) / standard error of the difference, of the channel where that is largest; nothing where unknown.
    std::optional<double> standardErrors;
};

struct Comparison {
    std::vector<RegionMeasures> regions; ///< in the order given
    size_t nonFiniteImage = 0, nonFiniteReference = 0;
    bool nonFiniteLeftOut = false; ///< there were some, and few enough
    std::vector<size_t> nonFinitePixels;
    std::vector<WorstPixel> worst; ///< the worst first, pixels that are not finite before all others
    /// Share of values (pixels and channels) further than 3 standard errors apart: 0.0027 where errors are normal and
    /// there is no bias. Nothing where neither image has standard errors.
    std::optional<double> beyondThreeStandardErrors;
    std::vector<double> relativeSquares; ///< by pixel, as in WorstPixel
};

/// Images of equal size (requireEqualSizes); `regions` hold pixels of them.
Comparison compareImages(const RadianceImage& image, const RadianceImage& reference, const std::vector<Region>& regions,
                         const CompareSettings& settings);

/// (I - R) / sqrt(sigmaI^2 + sigmaR^2) of value i, where an unknown sigma counts as 0; nothing where both are unknown,
/// 0 where both values and errors leave no difference.
std::optional<double> errorInStandardErrors(const RadianceImage& image, const RadianceImage& reference, size_t i);

double luminance(const float* rgb);

} // namespace quasilux
