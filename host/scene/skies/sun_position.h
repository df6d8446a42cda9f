// Where the sun stands, by place, date and time: within 0.01 degrees of NREL's solar position algorithm (Reda & Andreas
// 2004) from 1950 to 2100.
#pragma once

#include <glm/glm.hpp>

namespace quasilux {

struct PlaceOnEarth {
    double latitude = 0, longitude = 0; ///< degrees, to the north and to the east
};

struct LocalTime {
    int year = 2000, month = 1, day = 1; ///< Gregorian
    double hour = 0;                     ///< of the day, with minutes and seconds as a fraction
    double zone = 0;                     ///< hours ahead of universal time
};

struct SunPosition {
    double azimuth = 0;   ///< radians, from north over east
    double elevation = 0; ///< radians above the horizon, without refraction
};

SunPosition sunPosition(const PlaceOnEarth& place, const LocalTime& time);

/// Irradiance by the sun outside the atmosphere over its mean of the year: the inverse square of its distance (Spencer
/// 1971), to 1e-3.
double sunNearness(const LocalTime& time);

/// By how much air lifts the sun, radians: pressure in hPa, temperature in degrees Celsius (there, eq. 42). 0 where the
/// sun is wholly below the horizon.
double refraction(double elevation, double pressure, double temperature);

/// Unit direction; x points east, y north, z up.
glm::dvec3 towards(const SunPosition& sun);

} // namespace quasilux
