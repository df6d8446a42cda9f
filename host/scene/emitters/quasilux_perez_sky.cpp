// <emitter type="quasilux_perez_sky">: the all-weather sky of Perez et al. (host/scene/skies/perez_sky.h), by measured
// radiation or a weather file.
#include "scene/emitters/emitters.h"
#include "scene/skies/daylight.h"
#include "scene/skies/perez_sky.h"
#include "scene/skies/place_and_time.h"
#include "scene/skies/weather_file.h"
#include "scene/xml/xml_document.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double lowestDewPoint = -90, highestDewPoint = 70; // degrees Celsius, as EnergyPlus has them

struct Conditions {
    SunOfMap sun;
    Radiation radiation;
};

int timeOfWeather(Properties& properties, const std::string& name, int highest) {
    if (!properties.has(name))
        throw InputError(properties.element().where,
                         fmt::format("{} has a weather file; say month, day and hour (1 to 24, the one that ends then) "
                                     "too.",
                                     properties.describe()));
    return properties.integerWithin(name, 1, 1, highest);
}

Conditions readFromWeather(Properties& properties) {
    for (const char* other : {"sun_direction", "latitude", "longitude", "timezone", "year", "minute", "second",
                              "direct_normal_irradiance", "diffuse_horizontal_irradiance", "dew_point"})
        if (properties.has(other))
            throw InputError(properties.where(other),
                             fmt::format("{} has both weather and {}: the weather file says it. Remove one.",
                                         properties.describe(), other));
    const SourceLocation where = properties.where("weather");
    const std::string path = properties.context().files.resolve(properties.string("weather", ""), where);
    const int month = timeOfWeather(properties, "month", 12), day = timeOfWeather(properties, "day", 31),
              hour = timeOfWeather(properties, "hour", 24);
    const WeatherHour found = readWeatherHour(path, readFile(path, where, "weather"), month, day, hour, where);
    Conditions conditions{sunOfMap(found.place, found.time), found.radiation};
    conditions.radiation.sunNearness = conditions.sun.nearness;
    checkSunIsUp(properties, conditions.sun.towards);
    return conditions;
}

Conditions readMeasured(Properties& properties) {
    if (!properties.has("sun_direction") && givenPlaceOrTime(properties).empty())
        throw InputError(properties.element().where,
                         fmt::format("{} needs the sun: sun_direction, or place and time, or a weather file.",
                                     properties.describe()));
    Conditions conditions{readSunOfMap(properties), {}};
    Radiation& radiation = conditions.radiation;
    radiation.sunNearness = conditions.sun.nearness;
    radiation.dewPoint = properties.numberWithin("dew_point", radiation.dewPoint, lowestDewPoint, highestDewPoint);
    const auto areGiven = [&](const std::string& unit) {
        return properties.has("direct_normal_" + unit) && properties.has("diffuse_horizontal_" + unit);
    };
    if (areGiven("irradiance")) {
        radiation.directNormal = properties.numberAbove("direct_normal_irradiance", 0, 0, false);
        radiation.diffuseHorizontal = properties.numberAbove("diffuse_horizontal_irradiance", 0, 0, true);
    } else if (areGiven("illuminance")) {
        for (const char* alone : {"direct_normal_irradiance", "diffuse_horizontal_irradiance"})
            if (properties.has(alone))
                throw InputError(
                    properties.where(alone),
                    fmt::format("{} has {} alone; give both irradiances, or none.", properties.describe(), alone));
        radiation = radiationOfIlluminances(properties.numberAbove("direct_normal_illuminance", 0, 0, false),
                                            properties.numberAbove("diffuse_horizontal_illuminance", 0, 0, true),
                                            radiation, conditions.sun.towards);
    } else
        throw InputError(
            properties.element().where,
            fmt::format("{} needs direct_normal_irradiance and diffuse_horizontal_irradiance in W/m2, both "
                        "illuminances in lx, or a weather file.",
                        properties.describe()));
    return conditions;
}

} // namespace

SceneEmitter readPerezSky(Properties& properties) {
    Surroundings surroundings = newSurroundings(properties);
    const Conditions conditions = properties.has("weather") ? readFromWeather(properties) : readMeasured(properties);
    if (!(conditions.radiation.diffuseHorizontal > 0))
        throw InputError(properties.where("weather"), "the sky has no diffuse radiation in this hour; choose another.");
    Daylight daylight;
    daylight.sun = conditions.sun.towards;
    const PerezSky sky(conditions.radiation, daylight.sun);
    daylight.skyIlluminance = properties.numberAbove(
        "diffuse_horizontal_illuminance", sky.diffuseEfficacy() * conditions.radiation.diffuseHorizontal, 0, true);
    daylight.sunIlluminance = properties.numberAbove(
        "direct_normal_illuminance", sky.directEfficacy() * conditions.radiation.directNormal, 0, false);
    if (!properties.boolean("sun", true)) daylight.sunIlluminance = 0;
    const double scale = daylight.skyIlluminance /
                         illuminanceOnGround([&](const glm::dvec3& direction) { return sky.luminance(direction); });
    daylight.luminance = [&](const glm::dvec3& direction) { return scale * sky.luminance(direction); };
    addDaylight(properties, surroundings, daylight);
    return surroundings;
}

} // namespace quasilux
