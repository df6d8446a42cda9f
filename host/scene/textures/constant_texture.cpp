#include "scene/textures/constant_texture.h"

#include "scene/properties.h"
#include "scene/spectrum/spectrum.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

void require(Properties& properties, const std::string& name, const char* example) {
    if (!properties.has(name))
        throw InputError(properties.element().where,
                         fmt::format("{} needs the parameter '{}', such as {}.", properties.describe(), name, example));
}

/// One number for all channels, wherever it stands.
Rgb readUniform(Properties& properties, ColorUse) {
    require(properties, "value", "<float name=\"value\" value=\"0.5\"/>");
    properties.accept({"wavelength_min", "wavelength_max"});
    const float value = toFiniteFloat(properties.number("value", 0), properties.where("value"), "parameter 'value'");
    return {value, value, value};
}

/// A number, or a vector of three channels.
Rgb readRawConstant(Properties& properties, ColorUse) {
    require(properties, "value", "<float name=\"value\" value=\"0.5\"/>");
    const SourceLocation where = properties.where("value");
    const Element* given = properties.find("value");
    if (!given || given->tag != "vector") {
        const float value = toFiniteFloat(properties.number("value", 0), where, "parameter 'value'");
        return {value, value, value};
    }
    const glm::dvec3 value = properties.vector("value", {});
    const auto channel = [&](double number) { return toFiniteFloat(number, where, "parameter 'value'"); };
    return {channel(value.x), channel(value.y), channel(value.z)};
}

Rgb readSrgb(Properties& properties, ColorUse) {
    require(properties, "color", "<rgb name=\"color\" value=\"0.2,0.4,0.6\"/>");
    return properties.boolean("unbounded", false) ? properties.positiveColor("color", {})
                                                  : properties.reflectance("color", 0);
}

/// White of D65, which is that of sRGB, times a colour.
Rgb readD65(Properties& properties, ColorUse) {
    return properties.positiveColor("color", {1, 1, 1}) * static_cast<float>(properties.number("scale", 1));
}

Rgb colorOf(const Spectrum& spectrum, ColorUse use, Properties& properties) {
    return colorOfSpectrum(spectrum, use, properties.element().where, properties.context());
}

/// A list within a <string>.
std::vector<double> readList(Properties& properties, const std::string& name) {
    require(properties, name, "<string name=\"values\" value=\"0.2, 0.5\"/>");
    return parseNumbers(properties.string(name, ""), properties.where(name), fmt::format("parameter '{}'", name));
}

/// <spectrum name="value" …> within the plugin, by value or by file.
std::optional<Spectrum> readNestedSpectrum(Properties& properties) {
    const Element* value = properties.find("value");
    if (!value || value->tag != "spectrum") return std::nullopt;
    return spectrumOf(*value, "parameter 'value'", properties.context());
}

Rgb readRegular(Properties& properties, ColorUse use) {
    if (const auto nested = readNestedSpectrum(properties)) return colorOf(*nested, use, properties);
    Spectrum spectrum;
    spectrum.values = readList(properties, "values");
    require(properties, "wavelength_min", "<float name=\"wavelength_min\" value=\"400\"/>");
    require(properties, "wavelength_max", "<float name=\"wavelength_max\" value=\"700\"/>");
    const double shortest = properties.number("wavelength_min", 0), longest = properties.number("wavelength_max", 0);
    const auto intervals = static_cast<double>(spectrum.values.size()) - 1;
    for (size_t k = 0; k < spectrum.values.size(); ++k)
        spectrum.wavelengths.push_back(shortest + (longest - shortest) * static_cast<double>(k) / intervals);
    checkSpectrum(spectrum, properties.where("values"), properties.describe());
    return colorOf(spectrum, use, properties);
}

Rgb readIrregular(Properties& properties, ColorUse use) {
    if (const auto nested = readNestedSpectrum(properties)) return colorOf(*nested, use, properties);
    Spectrum spectrum{readList(properties, "wavelengths"), readList(properties, "values")};
    checkSpectrum(spectrum, properties.where("wavelengths"), properties.describe());
    return colorOf(spectrum, use, properties);
}

/// Planck's law per nanometre of wavelength: W m^-2 sr^-1 nm^-1 at `wavelength` nm and `temperature` K.
double planck(double wavelength, double temperature) {
    constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;
    const double metres = wavelength * 1e-9;
    return 2 * h * c * c / (std::pow(metres, 5) * std::expm1(h * c / (metres * k * temperature))) * 1e-9;
}

Rgb readBlackbody(Properties& properties, ColorUse use) {
    require(properties, "temperature", "<float name=\"temperature\" value=\"5000\"/>");
    const double temperature = properties.numberAbove("temperature", 0, 0, true);
    const double shortest = properties.number("wavelength_min", 0), longest = properties.number("wavelength_max", 1e6);
    const auto emitted = [&](double wavelength) {
        return wavelength < shortest || wavelength > longest ? 0 : planck(wavelength, temperature);
    };
    return colorOfSpectrum(emitted, use, properties.element().where, properties.context());
}

struct ConstantTexturePlugin {
    std::string_view name;
    Rgb (*read)(Properties&, ColorUse);
};

constexpr ConstantTexturePlugin constantTextures[] = {
    {"uniform", readUniform},         {"srgb", readSrgb},           {"d65", readD65},
    {"regular", readRegular},         {"irregular", readIrregular}, {"blackbody", readBlackbody},
    {"rawconstant", readRawConstant},
};

const ConstantTexturePlugin* findConstant(const Element& element) {
    const auto* const end = std::end(constantTextures);
    const auto* const found = std::find_if(std::begin(constantTextures), end, [&](const ConstantTexturePlugin& plugin) {
        return plugin.name == element.get("type");
    });
    return found == end ? nullptr : found;
}

} // namespace

bool isConstantTexture(const Element& element) { return findConstant(element) != nullptr; }

const Names& constantTextureNames() {
    static const Names names = [] {
        Names all;
        for (const ConstantTexturePlugin& plugin : constantTextures) all.push_back(plugin.name);
        return all;
    }();
    return names;
}

Rgb readConstantTexture(const Element& element, ColorUse use, LoadContext& context) {
    std::vector<const Element*>& open = context.openTextures;
    context.enter(element, open);
    context.textureIndex[&element].emplace(TextureUse::reflectance, -1);
    Properties properties(element, context);
    const Rgb color = findConstant(element)->read(properties, use);
    properties.finish();
    open.pop_back();
    return color;
}

} // namespace quasilux
