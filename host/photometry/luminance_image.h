// Images in the units of engineers: luminance or illuminance of each pixel.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct LuminanceImage {
    unsigned width = 0, height = 0;
    std::vector<float> values;        ///< row by row from the top, in `unit`
    std::vector<float> standardError; ///< upper bounds; empty: unknown
    bool isIlluminance = false;
    std::string conversion; ///< by which it was made of R, G, B
    /// Of a fisheye, if the header says so: how it shows directions, and how many degrees it is wide.
    std::optional<std::pair<std::string, double>> fisheye;
    bool isPerNanometre = false; ///< made of W per nanometre, so that it is some 107 times too low

    const char* unit() const { return isIlluminance ? "lx" : "cd/m²"; }
};

/// What R, G, B of the file are: radiometric (W) or photometric (lm); `asHeaderSays`, and radiometric where that is
/// silent.
enum class ImageUnits { asHeaderSays, photometric };

/// An image as readRadiance() takes it, of radiance or, if its header says so, of irradiance. 683 lm/W over the
/// primaries of sRGB (docs/method/meters.md). Throws InputError.
LuminanceImage readLuminance(const std::string& path, ImageUnits units);
/// What there is to say of its units; nothing, mostly.
std::optional<std::string> warningOfUnits(bool isPerNanometre, const std::string& unit, const std::string& path);

/// Of linear sRGB pixels, interleaved.
LuminanceImage luminanceImage(unsigned width, unsigned height, const std::vector<float>& rgb,
                              const std::vector<float>& standardError, bool unitsArePhotometric);

} // namespace quasilux
