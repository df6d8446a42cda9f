// Between what is radiant and what the eye sees of it.
#pragma once

#include "shared_types.h"

namespace quasilux {

/// Maximum luminous efficacy of radiation, lm/W (CIE 1931; SI definition of the candela, rounded).
inline constexpr double luminousEfficacy = 683;

/// The channels' shares of luminance: sRGB to CIE XYZ (IEC 61966-2-1).
inline double luminanceOf(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

} // namespace quasilux
