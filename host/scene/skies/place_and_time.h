// Parameters of emitters that say where the sun stands: latitude, longitude, timezone, year, month, day, hour, minute, second.
#pragma once

#include "scene/properties.h"
#include "scene/skies/sun_position.h"

namespace quasilux {

/// The first of these parameters that is given, or an empty string.
std::string givenPlaceOrTime(Properties& properties);

/// Missing ones are as in Mitsuba's sunsky: Tokyo on 10 July 2010 at 15:00. Throws InputError where a value is no such thing.
SunPosition readSunPosition(Properties& properties);

/// The sun at this elevation in radians must not be below the horizon: throws InputError.
void checkSunIsUp(Properties& properties, double elevation);

} // namespace quasilux
