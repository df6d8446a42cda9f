#include "photometry/luminance_image.h"

#include "compare/image_file.h"
#include "scene/photometric_units.h"
#include "util/error.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace quasilux {

namespace {

std::vector<float> photometricOf(const std::vector<float>& rgb, double efficacy) {
    std::vector<float> values;
    values.reserve(rgb.size() / 3);
    for (size_t i = 0; i + 2 < rgb.size(); i += 3)
        values.push_back(static_cast<float>(efficacy * luminanceOf(rgb[i], rgb[i + 1], rgb[i + 2])));
    return values;
}

/// Empty where the file cannot be read as an image.
OIIO::ImageSpec headerOf(const std::string& path) {
    const auto input = OIIO::ImageInput::open(path);
    return input ? input->spec() : OIIO::ImageSpec();
}

} // namespace

LuminanceImage luminanceImage(unsigned width, unsigned height, const std::vector<float>& rgb,
                              const std::vector<float>& standardError, bool unitsArePhotometric) {
    const double efficacy = unitsArePhotometric ? 1 : luminousEfficacy;
    return {width,
            height,
            photometricOf(rgb, efficacy),
            photometricOf(standardError, efficacy),
            false,
            unitsArePhotometric ? "0.2126 R + 0.7152 G + 0.0722 B"
                                : fmt::format("{:g} lm/W (0.2126 R + 0.7152 G + 0.0722 B)", luminousEfficacy),
            std::nullopt};
}

LuminanceImage readLuminance(const std::string& path, ImageUnits units) {
    const RadianceImage image = readRadiance(path);
    const OIIO::ImageSpec header = headerOf(path);
    const std::string stated = header.get_string_attribute("quasilux:units");
    const bool photometric = units == ImageUnits::photometric || stated == "photometric";
    LuminanceImage found = luminanceImage(image.width, image.height, image.radiance, image.standardError, photometric);
    found.isPerNanometre = !photometric && stated == "radiometric per nanometre";
    found.isIlluminance = header.get_string_attribute("quasilux:quantity") == "irradiance";
    const std::string projection = header.get_string_attribute("quasilux:projection");
    if (!projection.empty()) found.fisheye = {projection, header.get_float_attribute("quasilux:fov")};
    return found;
}

std::optional<std::string> warningOfUnits(bool isPerNanometre, const std::string& unit, const std::string& path) {
    if (!isPerNanometre) return std::nullopt;
    return fmt::format("{}: the sky of its scene is in W per nanometre, so that {} are some 107 times too low; set "
                       "sun_scale and sky_scale to 106.75 there, or begin the scene with <?quasilux "
                       "units=\"photometric\"?>",
                       path, unit);
}

} // namespace quasilux
