#include "scene/skies/daylight.h"

#include "scene/emitters/emitters.h"
#include "scene/skies/sky_image.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

using std::numbers::pi;

void addSun(Properties& properties, const glm::dvec3& towards, Rgb irradiance) {
    DirectionalEmitter emitter;
    emitter.id = idOf(properties.element()) + ".sun";
    emitter.where = properties.element().where;
    emitter.direction = glm::vec3(-towards);
    emitter.irradiance = irradiance;
    properties.context().scene.directionalEmitters.push_back(emitter);
}

} // namespace

double illuminanceOnGround(const std::function<double(const glm::dvec3&)>& luminance) {
    constexpr int rows = 720, columns = 720;
    double sum = 0;
    for (int row = 0; row < rows; ++row) {
        const double zenith = pi / 2 * (row + 0.5) / rows, across = std::sin(zenith);
        double ofRow = 0;
        for (int column = 0; column < columns; ++column) {
            const double turn = 2 * pi * (column + 0.5) / columns;
            ofRow += luminance({across * std::cos(turn), across * std::sin(turn), std::cos(zenith)});
        }
        sum += ofRow * across * std::cos(zenith);
    }
    return sum * (pi / 2 / rows) * (2 * pi / columns);
}

void addDaylight(Properties& properties, Surroundings& surroundings, const Daylight& daylight) {
    const double albedo = properties.share("ground_albedo", 0);
    const glm::dmat3 axes = axesOfSurroundings(properties);
    const Rgb colour = readLightColour(properties);
    const double factor = radiantFactor(properties);
    const SourceLocation& where = properties.element().where;
    const auto coloured = [&](double amount) {
        return colour * toFiniteFloat(factor * amount, where, "the luminance");
    };
    const double onGround = daylight.skyIlluminance + daylight.sunIlluminance * daylight.sun.z;
    surroundings.image =
        makeSkyImage(coarsestSkyHeight, axes, coloured(albedo / pi * onGround),
                     [&](const glm::dvec3& direction) { return coloured(daylight.luminance(direction)); });
    surroundings.image->groundBySun = coloured(albedo / pi * daylight.sunIlluminance * daylight.sun.z);
    if (daylight.sunIlluminance > 0) addSun(properties, axes * daylight.sun, coloured(daylight.sunIlluminance));
}

} // namespace quasilux
