// EnergyPlus weather files (.epw): one hour of them.
#pragma once

#include "scene/skies/perez_sky.h"
#include "scene/skies/sun_position.h"
#include "util/error.h"

#include <string>

namespace quasilux {

struct WeatherHour {
    PlaceOnEarth place;
    LocalTime time; ///< the middle of the hour
    Radiation radiation;
};

/// `content` is that of the file `path`. `hour` ends the hour, 1 to 24, as in the file. Throws InputError at a line of
/// the file where that is broken, and at `where` where it has no such hour.
WeatherHour readWeatherHour(const std::string& path, const std::string& content, int month, int day, int hour,
                            const SourceLocation& where);

} // namespace quasilux
