// Which sums a film keeps, and where they lie (kernels/film_sums.h).
#pragma once

#include "film_sums.h"

#include <cstddef>

namespace quasilux {

/// Of a film: what it keeps beside the image and its standard error.
struct FilmLayout {
    bool bias = true;       ///< estimate of the bias that the density radius leaves
    bool components = true; ///< the image by component; with it standard errors and bias of each class of light

    unsigned bits() const { return (bias ? FILM_HAS_BIAS : 0u) | (components ? FILM_HAS_COMPONENTS : 0u); }
    size_t floatsPerPixel() const { return FILM_PIXEL_FLOATS(bits()); }
    bool operator==(const FilmLayout&) const = default;
};

/// The value of a compensated sum.
inline double valueOfSum(const float* sum, size_t channel) { return double(sum[channel]) + sum[channel + 3]; }

} // namespace quasilux
