// Colours from <rgb>, <spectrum> and <float>.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

#include <algorithm>

namespace quasilux {

/// A uniform <spectrum> means equal energy at all wavelengths where it is emitted, and a plain number where it scales.
enum class ColorUse { scale, emission };

/// Linear sRGB of a parameter element. Throws InputError for anything but finite numbers.
Rgb parseColor(const Element& element, ColorUse use);

inline Rgb operator*(Rgb color, float factor) { return {color.r * factor, color.g * factor, color.b * factor}; }
inline bool isBlack(Rgb color) { return color.r == 0 && color.g == 0 && color.b == 0; }
inline float smallest(Rgb color) { return std::min(color.r, std::min(color.g, color.b)); }
inline float largest(Rgb color) { return std::max(color.r, std::max(color.g, color.b)); }
inline double mean(Rgb color) { return (double(color.r) + color.g + color.b) / 3; }

} // namespace quasilux
