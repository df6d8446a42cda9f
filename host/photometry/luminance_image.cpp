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

struct Header {
    OIIO::ImageSpec spec; ///< empty where the file cannot be read as an image
    std::string format;
};
Header headerOf(const std::string& path) {
    const auto input = OIIO::ImageInput::open(path);
    return input ? Header{input->spec(), input->format_name()} : Header();
}

/// Of a file that has a part of its view, or more than that.
std::string partOf(const OIIO::ImageSpec& spec) {
    if (spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
        spec.height == spec.full_height)
        return {};
    return fmt::format("{} x {} pixels from {}, {} on of a view of {} x {}", spec.width, spec.height,
                       spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width, spec.full_height);
}

void readView(const OIIO::ImageSpec& spec, LuminanceImage& image) {
    const std::string projection = spec.get_string_attribute("quasilux:projection");
    if (!projection.empty()) image.view = {projection, spec.get_float_attribute("quasilux:fov")};
    image.isViewUnknown = projection.empty() && spec.find_attribute("quasilux:version") != nullptr;
    image.part = partOf(spec);
}

} // namespace

LuminanceImage luminanceImage(unsigned width, unsigned height, const std::vector<float>& rgb,
                              const std::vector<float>& standardError, double efficacy) {
    LuminanceImage image;
    image.width = width;
    image.height = height;
    image.values = photometricOf(rgb, efficacy);
    image.standardError = photometricOf(standardError, efficacy);
    const std::string weights = "0.2126 R + 0.7152 G + 0.0722 B";
    image.conversion = efficacy == 1 ? weights : fmt::format("{:g} lm/W ({})", efficacy, weights);
    return image;
}

LuminanceImage readLuminance(const std::string& path, std::optional<double> efficacy) {
    const RadianceImage image = readRadiance(path);
    const auto [header, format] = headerOf(path);
    const std::string stated = header.get_string_attribute("quasilux:units");
    LuminanceImage found = luminanceImage(image.width, image.height, image.radiance, image.standardError,
                                          efficacy.value_or(stated == "photometric" ? 1 : luminousEfficacy));
    found.isIlluminance = header.get_string_attribute("quasilux:quantity") == "irradiance";
    readView(header, found);
    if (efficacy) return found;
    found.unitsWarning = warningOfUnits(stated == "radiometric per nanometre", found.unit(), path).value_or("");
    if (stated.empty() && format == "hdr")
        found.unitsWarning =
            fmt::format("{}: a Radiance picture says nothing of its units; taken as watts of {:g} lm/W. Give "
                        "--efficacy 179 where a program of Radiance made it, --photometric where it is in {}",
                        path, luminousEfficacy, found.unit());
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
