// Parameters of emitters that say where the sun stands: latitude, longitude, timezone, year, month, day, hour, minute,
// second.
#pragma once

#include "scene/properties.h"
#include "scene/skies/sun_position.h"

namespace quasilux {

/// The first of these parameters that is given, or an empty string.
std::string givenPlaceOrTime(Properties& properties);

/// Throws the InputError that one of them, `given`, stands beside a sun_direction.
[[noreturn]] void refuseBesideDirection(Properties& properties, const std::string& given);

/// Missing ones are as in Mitsuba's sunsky: Tokyo on 10 July 2010 at 15:00. Throws InputError where a value is no such
/// thing.
SunPosition readSunPosition(Properties& properties);

/// The sun above a map.
struct SunOfMap {
    glm::dvec3 towards{0, 0, 1}; ///< unit; +x is the east, +y the north, +z up
    double nearness = 1;         ///< irradiance outside the atmosphere over its mean of the year
};
/// By `sun_direction`, or by place and time, of which nothing but minute and second may be missing; refraction as at 10
/// degrees Celsius and 1010 hPa. Overhead where neither is given. Throws InputError where it is below the horizon.
SunOfMap readSunOfMap(Properties& properties);
/// Likewise, of a time and place that are known.
SunOfMap sunOfMap(const PlaceOnEarth& place, const LocalTime& time);

/// The sun in this direction, up is +z, must not be below the horizon: throws InputError.
void checkSunIsUp(Properties& properties, const glm::dvec3& towards);

} // namespace quasilux
