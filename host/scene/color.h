// Colours from <rgb>, <spectrum> and <float>.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

#include <algorithm>

namespace quasilux {

class LoadContext;

/// What a colour is for decides what a <spectrum> means: emitted, it is energy by wavelength; elsewhere a factor by
/// wavelength, seen under D65, which a reflectance keeps within [0, 1].
enum class ColorUse { reflectance, unbounded, emission };

/// Linear sRGB of a parameter element. Throws InputError for anything but finite numbers and spectra.
Rgb parseColor(const Element& element, ColorUse use, LoadContext& context);

/// Linear value of a channel within [0, 1] that is sRGB encoded (IEC 61966-2-1).
float decodeSrgb(float encoded);

/// Single precision. Throws InputError where the number is too large for it.
float toFiniteFloat(double value, const SourceLocation& where, const std::string& what);

inline Rgb operator*(Rgb color, float factor) { return {color.r * factor, color.g * factor, color.b * factor}; }
inline Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline bool isBlack(Rgb color) { return color.r == 0 && color.g == 0 && color.b == 0; }
inline float smallest(Rgb color) { return std::min(color.r, std::min(color.g, color.b)); }
inline float largest(Rgb color) { return std::max(color.r, std::max(color.g, color.b)); }
/// Of linear sRGB, as Mitsuba weights it (ITU-R BT.709).
inline double luminance(Rgb color) { return 0.212671 * color.r + 0.715160 * color.g + 0.072169 * color.b; }
inline double mean(Rgb color) { return (double(color.r) + color.g + color.b) / 3; }

} // namespace quasilux
