#include "scene/spectrum/spectrum.h"

#include "scene/spectrum/observer.h"
#include "scene/xml/numbers.h"
#include "scene/xml/xml_document.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

// Mitsuba's quadrature: this many wavelengths, ends included, each with an equal share of the range.
constexpr int spectrumSteps = 1000;

constexpr std::array<std::array<double, 3>, 3> srgbFromXyz = {{{3.240479, -1.537150, -0.498535},
                                                               {-0.969256, 1.875991, 0.041556},
                                                               {0.055648, -0.204043, 1.057311}}}; // ITU-R BT.709

struct Integrals {
    double x = 0, y = 0, z = 0;
};

double weightOf(const ObserverSample& observer, ColorUse use) { return use == ColorUse::emission ? 1 : observer.d65; }

Integrals integrate(const std::function<double(double)>& values, ColorUse use) {
    Integrals sum;
    for (int i = 0; i < spectrumSteps; ++i) {
        const double wavelength =
            shortestWavelength + i / double(spectrumSteps - 1) * (longestWavelength - shortestWavelength);
        const ObserverSample observer = observerAt(wavelength);
        const double value = values(wavelength) * weightOf(observer, use);
        sum.x += observer.x * value;
        sum.y += observer.y * value;
        sum.z += observer.z * value;
    }
    return sum;
}

/// What has luminance 1, summed over the steps: equal energy where it is emitted, otherwise D65 as Mitsuba takes it
/// (10568 by its constants; the table comes to 10567).
double whiteLuminance(ColorUse use) {
    constexpr double equalEnergy = 106.75025939941406, d65 = 10568;
    return (use == ColorUse::emission ? equalEnergy : d65) * spectrumSteps / (longestWavelength - shortestWavelength);
}

} // namespace

double Spectrum::at(double wavelength) const {
    if (wavelength < wavelengths.front() || wavelength > wavelengths.back()) return 0;
    const auto next = std::upper_bound(wavelengths.begin() + 1, wavelengths.end() - 1, wavelength);
    const auto k = static_cast<size_t>(next - wavelengths.begin());
    const double t = (wavelength - wavelengths[k - 1]) / (wavelengths[k] - wavelengths[k - 1]);
    return (1 - t) * values[k - 1] + t * values[k];
}

void checkSpectrum(const Spectrum& spectrum, const SourceLocation& where, const std::string& what) {
    const std::vector<double>& wavelengths = spectrum.wavelengths;
    if (wavelengths.size() != spectrum.values.size())
        throw InputError(where, fmt::format("{}: {} wavelengths and {} values; give as many of both.", what,
                                            wavelengths.size(), spectrum.values.size()));
    if (wavelengths.size() < 2)
        throw InputError(where, fmt::format("{}: a spectrum of {} wavelengths; give at least two, or one number alone.",
                                            what, wavelengths.size()));
    for (size_t k = 1; k < wavelengths.size(); ++k)
        if (!(wavelengths[k] > wavelengths[k - 1]))
            throw InputError(where, fmt::format("{}: the wavelength {} follows {}; they must increase.", what,
                                                wavelengths[k], wavelengths[k - 1]));
}

Spectrum parseSpectrum(const std::string& text, const SourceLocation& where, const std::string& what) {
    Spectrum spectrum;
    for (std::string_view pair : splitList(text)) {
        const size_t colon = pair.find(':');
        if (colon == std::string_view::npos)
            throw InputError(
                where, fmt::format("{}: '{}' is no pair; expected wavelength:value, such as 550:0.3.", what, pair));
        spectrum.wavelengths.push_back(parseNumber(pair.substr(0, colon), where, what));
        spectrum.values.push_back(parseNumber(pair.substr(colon + 1), where, what));
    }
    checkSpectrum(spectrum, where, what);
    return spectrum;
}

Spectrum readSpectrumFile(const std::string& path, const SourceLocation& where) {
    const std::string text = readTextFile(path, where, "spectrum");
    Spectrum spectrum;
    SourceLocation line{path, 0, 0};
    for (size_t begin = 0; begin < text.size();) {
        ++line.line;
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view content = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        const std::vector<std::string_view> words = splitList(content.substr(0, content.find('#')));
        if (words.empty()) continue;
        if (words.size() != 2)
            throw InputError(line, fmt::format("'{}' is no sample of a spectrum; expected a wavelength and a value.",
                                               content.substr(0, 40)));
        spectrum.wavelengths.push_back(parseNumber(words[0], line, "wavelength"));
        spectrum.values.push_back(parseNumber(words[1], line, "value"));
    }
    checkSpectrum(spectrum, SourceLocation{path, 0, 0}, "spectrum");
    return spectrum;
}

Spectrum spectrumOf(const Element& element, const std::string& what, LoadContext& context) {
    if (const std::string* file = element.find("filename"))
        return readSpectrumFile(context.files.resolve(*file, element.where), element.where);
    return parseSpectrum(element.get("value"), element.where, what);
}

Rgb colorOfSpectrum(const Spectrum& spectrum, ColorUse use, const SourceLocation& where, LoadContext& context) {
    return colorOfSpectrum([&](double wavelength) { return spectrum.at(wavelength); }, use, where, context);
}

Rgb colorOfSpectrum(const std::function<double(double)>& values, ColorUse use, const SourceLocation& where,
                    LoadContext& context) {
    const Integrals sum = integrate(values, use);
    if (!std::isfinite(sum.x) || !std::isfinite(sum.y) || !std::isfinite(sum.z))
        throw InputError(where, "the values of the spectrum are too large to be added up; give smaller ones.");
    const double scale = 1 / whiteLuminance(use);
    std::array<float, 3> color{};
    bool clamped = false;
    for (size_t c = 0; c < 3; ++c) {
        const auto& row = srgbFromXyz[c];
        const double value = scale * (row[0] * sum.x + row[1] * sum.y + row[2] * sum.z);
        const double most = use == ColorUse::reflectance ? 1 : value;
        const double kept = std::max(0.0, std::min(value, most));
        clamped |= kept != value;
        color[c] = toFiniteFloat(kept, where, "the colour of the spectrum");
    }
    if (clamped)
        context.warn(where,
                     fmt::format("the spectrum has a colour outside of sRGB; it is taken as ({:.4g}, {:.4g}, {:.4g}).",
                                 color[0], color[1], color[2]));
    return {color[0], color[1], color[2]};
}

} // namespace quasilux
