// <emitter type="sunsky">: Mitsuba's clear sky and sun (host/scene/skies/hosek_wilkie.h) as one image that surrounds
// the scene.
#include "scene/emitters/emitters.h"
#include "scene/photometric_units.h"
#include "scene/skies/hosek_wilkie.h"
#include "scene/skies/place_and_time.h"
#include "scene/skies/sky_image.h"
#include "scene/skies/sun_disc.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

struct SunSky {
    double turbidity = 3; // 1 clear, 10 hazy
    Rgb albedo{};
    double sunScale = 1, skyScale = 1;
    double sunHalfAngle = 0; // radians
    bool complexSun = false;
    glm::dvec3 sun{}; // towards it, up is +z
};

/// Mitsuba's default is the angle for which the sun's radiance is known; with others its irradiance stays the same.
double readSunHalfAngle(Properties& properties) {
    const double aperture = properties.number("sun_aperture", hosekWilkieSunAperture() * 180 / pi);
    if (!(aperture > 0 && aperture < 90))
        throw InputError(
            properties.where("sun_aperture"),
            fmt::format("parameter 'sun_aperture' is {}; expected an angle above 0 and below 90 degrees.", aperture));
    return std::max(aperture * pi / 360, narrowestHalfAngle());
}

/// In the axes of the sky. As in Mitsuba `sun_direction` is in the world, and by place and time +x is the south, +y the
/// west.
glm::dvec3 readSun(Properties& properties, const glm::dmat3& axes) {
    glm::dvec3 sun;
    if (properties.has("sun_direction")) {
        const std::string other = givenPlaceOrTime(properties);
        if (!other.empty()) refuseBesideDirection(properties, other);
        sun = glm::transpose(axes) * properties.direction("sun_direction", {0, 0, 1});
    } else {
        const glm::dvec3 onMap = towards(readSunPosition(properties));
        sun = {-onMap.y, -onMap.x, onMap.z};
    }
    checkSunIsUp(properties, sun);
    return sun;
}

SunSky readSunSky(Properties& properties, const glm::dmat3& axes) {
    SunSky found;
    found.turbidity = properties.numberWithin("turbidity", 3, 1, 10);
    found.albedo = properties.reflectance("albedo", 0.3F);
    found.sunScale = properties.numberAbove("sun_scale", 1, 0, false);
    found.skyScale = properties.numberAbove("sky_scale", 1, 0, false);
    found.sunHalfAngle = readSunHalfAngle(properties);
    found.complexSun = properties.boolean("complex_sun", false);
    found.sun = readSun(properties, axes);
    return found;
}

/// Whether the model's radiance per nanometre becomes that of all light, or nothing
/// (docs/reference/photometry.md#skies).
bool isScaledToWatts(double scale) { return scale == 0 || std::abs(scale / hosekWilkieResponse() - 1) < 0.01; }

/// sRGB does not hold every colour of the sky; what is left out of it is light that the other channels have too much
/// of.
Rgb withinGamut(const glm::dvec3& radiance) {
    const glm::dvec3 positive = glm::max(radiance, glm::dvec3(0));
    return {static_cast<float>(positive.x), static_cast<float>(positive.y), static_cast<float>(positive.z)};
}

SunDisc discOf(const SunSky& given, double factor) {
    const HosekWilkieSun sun(given.turbidity);
    const double spread =
        (1 - std::cos(hosekWilkieSunAperture() / 2)) / (1 - std::cos(given.sunHalfAngle)) * given.sunScale * factor;
    SunDisc disc{given.sun, given.sunHalfAngle, {}};
    if (given.complexSun) {
        disc.radiance = [=](const glm::dvec3& direction) {
            const double away = glm::length(glm::cross(direction, given.sun)) / std::sin(given.sunHalfAngle);
            const double cosSurface = std::sqrt(std::max(1 - away * away, 0.0));
            return glm::max(sun.radiance(std::asin(std::min(direction.z, 1.0)), cosSurface), glm::dvec3(0)) * spread;
        };
    } else {
        const glm::dvec3 mean =
            glm::max(sun.meanRadiance(std::asin(std::min(given.sun.z, 1.0))), glm::dvec3(0)) * spread;
        disc.radiance = [mean](const glm::dvec3&) { return mean; };
    }
    return disc;
}

} // namespace

SceneEmitter readSunSky(Properties& properties) {
    Surroundings surroundings = newSurroundings(properties);
    const glm::dmat3 axes = axesOfSurroundings(properties);
    const SunSky given = readSunSky(properties, axes);
    if (given.sunScale == 0 && given.skyScale == 0)
        return surroundings; // off, as surroundings without an image and radiance
    const double factor = isPhotometric(properties) ? luminousEfficacy * hosekWilkieResponse() : 1;
    surroundings.isPerNanometre =
        !isPhotometric(properties) && !(isScaledToWatts(given.sunScale) && isScaledToWatts(given.skyScale));
    const HosekWilkieSky sky(given.turbidity, given.albedo, std::asin(std::min(given.sun.z, 1.0)));
    const bool hasSun = given.sunScale > 0;
    const unsigned height = hasSun ? skyHeightFor(given.sunHalfAngle) : coarsestSkyHeight;
    EnvironmentImage image = makeSkyImage(height, axes, {0, 0, 0}, [&](const glm::dvec3& direction) {
        return withinGamut(sky.radiance(direction.z, glm::dot(direction, given.sun)) * (given.skyScale * factor));
    });
    if (hasSun) addSunDisc(image, discOf(given, factor));
    surroundings.image = std::move(image);
    return surroundings;
}

} // namespace quasilux
