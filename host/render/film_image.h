// The developed film: means over passes and their standard error. Row 0 is the top; pixels are interleaved RGB.
#pragma once

#include "shared_types.h"

#include <array>
#include <string>
#include <vector>

namespace quasilux {

struct FilmImage {
    unsigned width = 0, height = 0;
    unsigned passes = 0;
    std::vector<float> radiance;      ///< width*height*3, W sr^-1 m^-2: the sum of the components
    std::vector<float> standardError; ///< width*height*3, of `radiance`, from independent passes
    /// By FILM component (LIGHT_* and FILM_EMISSION), each width*height*3, or empty where the scene has no such light.
    std::array<std::vector<float>, FILM_COMPONENTS> components;
};

/// Layer name of a component: "direct", "caustic", "quasi_caustic", "diffuse", "emission".
std::string componentName(unsigned component);

/// The image of both sets of passes together: independent passes merge as sums. Sizes must agree.
FilmImage mergePasses(const FilmImage& a, const FilmImage& b);

/// Over pixels, of luminance standard error / luminance, each denominator at least 1 % of the mean luminance.
/// Infinity where fewer than two passes tell nothing of the error; 0 for a black image.
struct RelativeError {
    double mean = 0;
    double percentile95 = 0;
};
RelativeError relativeError(const FilmImage& image);

/// relativeError().mean: what the stop rule looks at.
double meanRelativeError(const FilmImage& image);

} // namespace quasilux
