// <emitter type="quasilux_cie_sky">: one of the CIE's standard skies as surroundings, with or without the sun's own
// light.
#include "scene/emitters/cie_sky.h"
#include "scene/emitters/emitters.h"
#include "scene/skies/daylight.h"
#include "scene/skies/place_and_time.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

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

/// cd/m² at the zenith; `perZenith` lx come from a sky with 1 cd/m² there.
double readZenith(Properties& properties, double perZenith) {
    if (properties.has("zenith_luminance")) {
        if (properties.has("illuminance"))
            throw InputError(
                properties.where("illuminance"),
                fmt::format("{} has both zenith_luminance and illuminance; keep one.", properties.describe()));
        return properties.numberAbove("zenith_luminance", 0, 0, true);
    }
    return properties.numberAbove("illuminance", 10000, 0, true) / perZenith;
}

} // namespace

SceneEmitter readCieSky(Properties& properties) {
    Surroundings surroundings = newSurroundings(properties);
    const int type = readSkyType(properties);
    if (dependsOnSun(type) && !properties.has("sun_direction") && givenPlaceOrTime(properties).empty())
        throw InputError(properties.where("sky_type"),
                         fmt::format("{} needs the sun, as its sky_type is {}: sun_direction, or place and time; only "
                                     "types 1, 3, 5 and 16 are the same wherever it stands.",
                                     properties.describe(), type));
    Daylight daylight;
    daylight.sun = readSunOfMap(properties).towards;
    const double perZenith = cieSkyIlluminance(type, daylight.sun);
    const double zenith = readZenith(properties, perZenith);
    daylight.luminance = [&](const glm::dvec3& direction) {
        return zenith * cieSkyLuminance(type, direction, daylight.sun);
    };
    daylight.skyIlluminance = zenith * perZenith;
    daylight.sunIlluminance = properties.numberAbove("sun_illuminance", 0, 0, false);
    addDaylight(properties, surroundings, daylight);
    return surroundings;
}

} // namespace quasilux
