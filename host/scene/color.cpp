// Colours from <rgb>, <spectrum> and <float>.
#include "scene/color.h"

#include "scene/xml/numbers.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Equal-energy white (CIE illuminant E) of luminance 1 in linear sRGB, as Mitsuba's RGB modes turn a uniform spectrum
/// into a colour.
constexpr Rgb equalEnergyWhite = {1.2048f, 0.9482f, 0.9087f};

float linearFromSrgb(int byte) {
    const double encoded = byte / 255.0;
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

float toFloat(double value, const Element& element) {
    const float single = static_cast<float>(value);
    if (!std::isfinite(single))
        throw InputError(element.where, fmt::format("parameter '{}': {} is out of the range of single precision.",
                                                    element.get("name"), value));
    return single;
}

Rgb parseHex(const Element& element, const std::string& text) {
    const bool valid = text.size() == 7 && text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
    if (!valid)
        throw InputError(element.where, fmt::format("parameter '{}': '{}' is not a colour; expected #rrggbb.",
                                                    element.get("name"), text));
    const auto channel = [&](size_t at) { return linearFromSrgb(std::stoi(text.substr(at, 2), nullptr, 16)); };
    return {channel(1), channel(3), channel(5)};
}

Rgb parseRgb(const Element& element) {
    const std::string& text = element.get("value");
    const std::string what = fmt::format("parameter '{}'", element.get("name"));
    if (!text.empty() && text.front() == '#') return parseHex(element, text);
    const std::vector<double> values = parseNumbers(text, element.where, what);
    if (values.size() != 1 && values.size() != 3)
        throw InputError(element.where, fmt::format("{}: <rgb> has {} numbers; expected three, one, or #rrggbb.", what,
                                                    values.size()));
    const size_t step = values.size() == 3 ? 1 : 0;
    return {toFloat(values[0], element), toFloat(values[step], element), toFloat(values[2 * step], element)};
}

float parseUniformSpectrum(const Element& element) {
    const std::string& text = element.get("value");
    const std::string what = fmt::format("parameter '{}'", element.get("name"));
    if (!element.find("value") || element.find("filename") || element.find("type") ||
        text.find(':') != std::string::npos)
        throw InputError(element.where, what + ": spectra by wavelength are not supported (quasilux computes in RGB); "
                                               "give one number for a uniform spectrum, or an <rgb>.");
    return toFloat(parseNumber(text, element.where, what), element);
}

} // namespace

Rgb parseColor(const Element& element, ColorUse use) {
    if (element.tag == "rgb") return parseRgb(element);
    if (element.tag == "spectrum") {
        const float value = parseUniformSpectrum(element);
        return use == ColorUse::emission ? equalEnergyWhite * value : Rgb{value, value, value};
    }
    if (element.tag == "float" || element.tag == "integer") {
        const std::string what = fmt::format("parameter '{}'", element.get("name"));
        const float value = toFloat(parseNumber(element.get("value"), element.where, what), element);
        return {value, value, value};
    }
    throw InputError(element.where, fmt::format("parameter '{}' is a <{}>; expected <rgb>, <spectrum> or <float>.",
                                                element.get("name"), element.tag));
}

} // namespace quasilux
