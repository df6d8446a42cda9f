// A picture to look at: tone-mapped 8-bit sRGB.
#pragma once

#include "output/render_record.h"

#include <optional>

namespace quasilux {

/// Displayed luminance of luminance L: with x = scale L, x (1 + x / white^2) / (1 + x). That is the extended curve of
/// Reinhard et al. 2002 (Photographic Tone Reproduction for Digital Images), equation 4; white = 1 makes it displayed =
/// x.
struct ToneCurve {
    double scale = 1; ///< on radiance, (W sr^-1 m^-2)^-1
    double white = 1; ///< the scaled luminance that is displayed as 1, at least 1
};

/// What the user asked for; at most one is set.
struct ExposureChoice {
    std::optional<double> stops; ///< relative to the automatic exposure
    std::optional<double> scale; ///< absolute, no highlight compression: pictures of several renders compare
};

/// Automatic: the 90th percentile of the luminance of pixels that are not black is scaled to 0.8, and white is the
/// 99.9th percentile. Few very bright pixels thus do not darken the rest.
ToneCurve chooseToneCurve(const FilmImage& image, const ExposureChoice& choice);

/// Interleaved 8-bit sRGB, width*height*3. The curve acts on luminance and keeps the hue; each channel is then clamped.
std::vector<uint8_t> toneMap(const FilmImage& image, const ToneCurve& curve);

/// The curve and the settings go to the file's text chunks. Whole or not at all. Throws std::runtime_error.
void writePng(const std::string& path, const FilmImage& image, const ToneCurve& curve, const RenderRecord& record);

} // namespace quasilux
