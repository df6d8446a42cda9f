// <medium type="homogeneous">: the same everywhere within it.
#include "scene/media/medium_plugin.h"
#include "scene/volumes/volume_plugin.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// A volume of this name that is the same everywhere, or nothing.
std::optional<Rgb> constantOf(Properties& properties, const std::string& name) {
    const Element* element = properties.volume(name);
    if (!element) return std::nullopt;
    const VolumeDescription volume = readVolume(*element, properties.context());
    const size_t channels = volume.device.channels;
    if (volume.values.size() != channels)
        throw InputError(element->where, fmt::format("'{}' of {} is the same everywhere; a medium in which it varies "
                                                     "is of type \"heterogeneous\", whose sigma_t may be a constvolume "
                                                     "about the shape.",
                                                     name, properties.describe()));
    return Rgb{volume.values[0], volume.values[channels / 2], volume.values[channels - 1]};
}

struct Coefficients {
    Rgb extinction, albedo;
};

/// Those of Mitsuba 0.x: scattering and absorption coefficients.
Coefficients readFormer(Properties& properties) {
    for (const char* name : {"sigma_t", "albedo"})
        if (properties.has(name) || properties.volume(name))
            throw InputError(properties.where("sigma_s"),
                             fmt::format("{} has both sigma_s, sigma_a and {}; give sigma_t "
                                         "and albedo alone.",
                                         properties.describe(), name));
    const Rgb scattering = properties.positiveColor("sigma_s", {}, ColorUse::reflectance),
              absorption = properties.positiveColor("sigma_a", {}, ColorUse::reflectance);
    const Rgb sum{scattering.r + absorption.r, scattering.g + absorption.g, scattering.b + absorption.b};
    const auto share = [](float part, float whole) { return whole > 0 ? part / whole : 0; };
    return {sum, {share(scattering.r, sum.r), share(scattering.g, sum.g), share(scattering.b, sum.b)}};
}

Coefficients readCoefficients(Properties& properties) {
    if (properties.has("sigma_s") && properties.has("sigma_a")) return readFormer(properties);
    for (const char* name : {"sigma_s", "sigma_a"})
        properties.refuse(name, "give both sigma_s and sigma_a, or, as in Mitsuba 3, sigma_t = sigma_a + sigma_s and "
                                "albedo = sigma_s / sigma_t");
    const std::optional<Rgb> extinction = constantOf(properties, "sigma_t"), albedo = constantOf(properties, "albedo");
    return {extinction ? *extinction : properties.positiveColor("sigma_t", {1, 1, 1}, ColorUse::reflectance),
            albedo ? *albedo : properties.reflectance("albedo", 0.75f)};
}

} // namespace

void readHomogeneous(Properties& properties, MediumDescription& medium) {
    const Coefficients coefficients = readCoefficients(properties);
    const auto scale = static_cast<float>(properties.numberAbove("scale", 1, 0, false));
    medium.sigmaT = coefficients.extinction * scale;
    if (!std::isfinite(largest(medium.sigmaT)) || std::isnan(smallest(medium.sigmaT)))
        throw InputError(
            properties.where("scale"),
            fmt::format("sigma_t times scale of {} is out of the range of single precision.", properties.describe()));
    medium.albedo = coefficients.albedo;
    if (largest(medium.albedo) > 1)
        throw InputError(properties.element().where,
                         fmt::format("the albedo of {} has a channel above 1: more light scattered than there was.",
                                     properties.describe()));
}

} // namespace quasilux
