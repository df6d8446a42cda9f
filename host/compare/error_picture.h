// Pictures of the error in false colours, and pictures as text for a page.
#pragma once

#include "compare/measures.h"

#include <cstdint>

namespace quasilux {

/// 8-bit RGB, width*height*3.
using Picture = std::vector<uint8_t>;

/// Pixels that are not finite, in every error picture; no error has this colour.
inline constexpr std::array<uint8_t, 3> nonFiniteColour{255, 0, 255};
/// Ends of the scales.
inline constexpr double signedScale = 0.25;                        ///< relative difference of full red or blue
inline constexpr double squareScaleFrom = 1e-6, squareScaleTo = 1; ///< of relMSE: black and white
inline constexpr double standardErrorScale = 5;                    ///< standard errors of full red or blue

/// Difference of luminance relative to sqrt(R^2 + 0.01 mean(R)^2): white none, red too bright, blue too dark.
Picture signedPicture(const RadianceImage& image, const RadianceImage& reference);
/// relMSE of each pixel on a logarithmic scale from black over red and yellow to white.
Picture squarePicture(const Comparison& comparison);
/// Difference of luminance in its standard errors: colours as of signedPicture(). Empty where no standard error is
/// known.
Picture standardErrorPicture(const RadianceImage& image, const RadianceImage& reference);

/// Radiance with 8 bits to the mantissa of each channel and a common exponent (Ward 1991, Real Pixels): the upper half
/// of the picture, 2*height rows, is the mantissas, the lower half the exponent. A channel is mantissa * 2^(exponent -
/// 136); negative values become 0, and what is not finite has the exponent 255.
Picture sharedExponentPicture(const RadianceImage& image);

/// A PNG file. Throws std::runtime_error.
std::vector<unsigned char> pngBytes(const Picture& picture, unsigned width, unsigned height);
/// "data:image/png;base64,...". Throws std::runtime_error.
std::string pngDataUri(const Picture& picture, unsigned width, unsigned height);

} // namespace quasilux
