// <emitter type="quasilux_cie_sky">: one of the CIE's standard skies as surroundings, with or without the sun's own light.
#include "scene/emitters/cie_sky.h"
#include "scene/emitters/emitters.h"
#include "scene/skies/sky_image.h"

#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr unsigned skyHeight = 721; // rows: a quarter of a degree each

int readSkyType(Properties& properties) {
    const int64_t type = properties.integer("sky_type", cieSkyTypes);
    if (type < 1 || type > cieSkyTypes)
        throw InputError(
            properties.where("sky_type"),
            fmt::format("parameter 'sky_type' is {}; expected 1 to 15 of CIE S 011, or 16, its traditional "
                        "overcast sky.",
                        type));
    return static_cast<int>(type);
}

/// Towards it, up is +z.
glm::dvec3 readSun(Properties& properties) {
    const glm::dvec3 sun = properties.direction("sun_direction", {0, 0, 1});
    if (sun.z < 0)
        throw InputError(
            properties.where("sun_direction"),
            "the sun is below the horizon (z < 0); CIE S 011 has no such sky. Point sun_direction upwards.");
    return sun;
}

/// cd/m² at the zenith.
double readZenith(Properties& properties, int type, const glm::dvec3& sun) {
    if (properties.has("zenith_luminance")) {
        if (properties.has("illuminance"))
            throw InputError(
                properties.where("illuminance"),
                fmt::format("{} has both zenith_luminance and illuminance; keep one.", properties.describe()));
        return properties.numberAbove("zenith_luminance", 0, 0, true);
    }
    return properties.numberAbove("illuminance", 10000, 0, true) / cieSkyIlluminance(type, sun);
}

void addSun(Properties& properties, const glm::dvec3& towards, Rgb irradiance) {
    DirectionalEmitter emitter;
    emitter.id = idOf(properties.element()) + ".sun";
    emitter.where = properties.element().where;
    emitter.direction = glm::vec3(-towards);
    emitter.irradiance = irradiance;
    properties.context().scene.directionalEmitters.push_back(emitter);
}

} // namespace

void readCieSky(Properties& properties) {
    Surroundings& surroundings = addSurroundings(properties);
    const int type = readSkyType(properties);
    const glm::dvec3 sun = readSun(properties);
    const double zenith = readZenith(properties, type, sun);
    const double albedo = properties.share("ground_albedo", 0);
    const double sunIlluminance = properties.numberAbove("sun_illuminance", 0, 0, false);
    const glm::dmat3 axes = axesOfSurroundings(properties);
    const Rgb colour = readLightColour(properties);
    const double factor = radiantFactor(properties);
    const SourceLocation& where = properties.element().where;
    const auto coloured = [&](double amount) {
        return colour * toFiniteFloat(factor * amount, where, "the luminance");
    };

    const double onGround = zenith * cieSkyIlluminance(type, sun) + sunIlluminance * sun.z;
    const Rgb ofZenith = coloured(zenith);
    surroundings.image =
        makeSkyImage(skyHeight, axes, coloured(albedo / std::numbers::pi * onGround), [&](const glm::dvec3& direction) {
            return ofZenith * static_cast<float>(cieSkyLuminance(type, direction, sun));
        });
    if (sunIlluminance > 0) addSun(properties, axes * sun, coloured(sunIlluminance));
}

} // namespace quasilux
