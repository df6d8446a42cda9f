// Colours from <rgb>, <spectrum> and <float>.
#include "scene/color.h"

#include "scene/spectrum/spectrum.h"
#include "scene/xml/numbers.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Equal-energy white (CIE illuminant E) of luminance 1 in linear sRGB, as Mitsuba's RGB modes turn a uniform spectrum
/// into a colour.
constexpr Rgb equalEnergyWhite = {1.204794f, 0.948291f, 0.908916f};

float linearFromSrgb(int byte) {
    const double encoded = byte / 255.0;
    return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
}

std::string whatOf(const Element& element) { return fmt::format("parameter '{}'", element.get("name")); }

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
    const std::string what = whatOf(element);
    if (!text.empty() && text.front() == '#') return parseHex(element, text);
    const std::vector<double> values = parseNumbers(text, element.where, what);
    if (values.size() != 1 && values.size() != 3)
        throw InputError(element.where, fmt::format("{}: <rgb> has {} numbers; expected three, one, or #rrggbb.", what,
                                                    values.size()));
    const size_t step = values.size() == 3 ? 1 : 0;
    return {toFiniteFloat(values[0], element.where, what), toFiniteFloat(values[step], element.where, what),
            toFiniteFloat(values[2 * step], element.where, what)};
}

Rgb uniformSpectrum(float value, ColorUse use) {
    return use == ColorUse::emission ? equalEnergyWhite * value : Rgb{value, value, value};
}

Rgb parseSpectrumParameter(const Element& element, ColorUse use, LoadContext& context) {
    const std::string* text = element.find("value");
    const std::string* file = element.find("filename");
    const std::string what = whatOf(element);
    if ((text == nullptr) == (file == nullptr))
        throw InputError(element.where, fmt::format("{}: give either value or filename of a <spectrum>.", what));
    if (text && text->find(':') == std::string::npos)
        return uniformSpectrum(toFiniteFloat(parseNumber(*text, element.where, what), element.where, what), use);
    return colorOfSpectrum(spectrumOf(element, what, context), use, element.where, context);
}

} // namespace

float toFiniteFloat(double value, const SourceLocation& where, const std::string& what) {
    const float single = static_cast<float>(value);
    if (!std::isfinite(single))
        throw InputError(where, fmt::format("{}: {} is out of the range of single precision.", what, value));
    return single;
}

float decodeSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Rgb parseColor(const Element& element, ColorUse use, LoadContext& context) {
    if (element.tag == "rgb") return parseRgb(element);
    if (element.tag == "spectrum") return parseSpectrumParameter(element, use, context);
    if (element.tag == "float" || element.tag == "integer") {
        const std::string what = whatOf(element);
        const float value = toFiniteFloat(parseNumber(element.get("value"), element.where, what), element.where, what);
        return {value, value, value};
    }
    throw InputError(element.where, fmt::format("parameter '{}' is a <{}>; expected <rgb>, <spectrum> or <float>.",
                                                element.get("name"), element.tag));
}

} // namespace quasilux
