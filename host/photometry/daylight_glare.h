// Daylight Glare Probability of an image (Wienold & Christoffersen 2006, "Evaluation methods and development of a new
// glare prediction model for daylight environments with the use of CCD cameras", Energy and Buildings 38).
#pragma once

#include "photometry/luminance_image.h"

#include <optional>

namespace quasilux {

/// How an image shows directions; r is the distance from its middle, theta the angle from the line of sight.
enum class Projection {
    perspective,
    equidistant, ///< fisheye, r ~ theta
    equisolid,   ///< fisheye, r ~ sin(theta / 2)
    orthographic ///< fisheye, r ~ sin theta: each pixel has the same share of the illuminance
};
std::vector<std::string> projectionNames();
Projection parseProjection(const std::string& name);

struct View {
    Projection projection = Projection::equidistant;
    double width = 3.141592653589793; ///< radians that the image's width spans
};

struct DaylightGlare {
    struct Source {
        double luminance = 0, solidAngle = 0, positionIndex = 1; ///< cd/m², sr
        size_t pixels = 0;
    };
    double probability = 0;
    std::optional<double> standardError;    ///< at most; where the image has standard errors
    double illuminance = 0;                 ///< vertical, at the eye, lx
    std::optional<double> illuminanceError; ///< at most
    double covered = 1;                     ///< share of the illuminance of a uniform field that the image shows
    std::vector<Source> sources;            ///< the strongest first
};

/// 5.87e-5 Ev + 9.18e-2 log10(1 + Σ L² ω / (Ev^1.87 P²)) + 0.16, at most 1. Sources are pixels side by side of at least
/// `threshold` cd/m². `illuminance`: Ev as it was measured; else it is that of the image.
DaylightGlare daylightGlare(const LuminanceImage& image, const View& view, double threshold,
                            std::optional<double> illuminance);

/// The formula is made from 380 lx and of 0.2 to 0.8.
inline constexpr double leastIlluminanceOfGlare = 380, leastProbability = 0.2, largestProbability = 0.8;

} // namespace quasilux
