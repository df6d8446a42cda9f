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
    /// If the header says so: how it shows directions, as `quasilux dgp` names that, and how many degrees it is wide.
    std::optional<std::pair<std::string, double>> view;
    bool isViewUnknown = false; ///< quasilux made it, and says of no view
    std::string part;           ///< where the file has other pixels than those of its view: which; empty: it has not
    std::string unitsWarning;   ///< empty: none

    const char* unit() const { return isIlluminance ? "lx" : "cd/m²"; }
};

/// An image as readRadiance() takes it, of radiance or, if its header says so, of irradiance. `efficacy`: lm/W over the
/// primaries of sRGB, 1 of what is photometric already; else as the header says, and 683 where that is silent
/// (docs/method/meters.md). Throws InputError.
LuminanceImage readLuminance(const std::string& path, std::optional<double> efficacy);
/// What there is to say of the units of an image or a table; nothing, mostly.
std::optional<std::string> warningOfUnits(bool isPerNanometre, const std::string& unit, const std::string& path);

/// Of linear sRGB pixels, interleaved.
LuminanceImage luminanceImage(unsigned width, unsigned height, const std::vector<float>& rgb,
                              const std::vector<float>& standardError, double efficacy);

} // namespace quasilux
