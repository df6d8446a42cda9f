#include "scene/skies/sun_position.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

constexpr double radiansOfDegree = std::numbers::pi / 180;
constexpr double epoch2000 = 2451545;       // Julian day of noon on 1 January 2000
constexpr double daysOfCentury = 36525;     // Julian
constexpr double clockError = 69.0 / 86400; // days by which the Earth's turn lags behind even time; it was 29 s in 1950

double sinOf(double degrees) { return std::sin(degrees * radiansOfDegree); }
double cosOf(double degrees) { return std::cos(degrees * radiansOfDegree); }

/// Of the Gregorian calendar (Meeus, Astronomical Algorithms, 2nd ed. 1998, chapter 7).
double julianDay(const LocalTime& time) {
    const bool early = time.month <= 2;
    const int year = time.year - (early ? 1 : 0), month = time.month + (early ? 12 : 0);
    const double century = std::floor(year / 100.0);
    return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + time.day + 2 - century +
           std::floor(century / 4) - 1524.5 + (time.hour - time.zone) / 24;
}

struct Equatorial {
    double rightAscension, declination; // radians
    double siderealTime;                // at Greenwich, degrees
};

/// Meeus 1998, chapters 12, 22 and 25, with the perturbations by Venus, Jupiter and the Moon of his Astronomical
/// Formulae for Calculators (1982), chapter 18.
Equatorial sunAt(double day) {
    const double t = (day + clockError - epoch2000) / daysOfCentury, since1900 = t + 1;
    const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537), node = 125.04 - 1934.136 * t;
    const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * sinOf(anomaly) +
                          (0.019993 - 0.000101 * t) * sinOf(2 * anomaly) + 0.000289 * sinOf(3 * anomaly);
    const double perturbed = 0.00134 * cosOf(153.23 + 22518.7541 * since1900) +
                             0.00154 * cosOf(216.57 + 45037.5082 * since1900) +
                             0.00200 * cosOf(312.69 + 32964.3577 * since1900) +
                             0.00179 * sinOf(350.74 + since1900 * (445267.1142 - 0.00144 * since1900)) +
                             0.00178 * sinOf(231.19 + 20.20 * since1900);
    const double nutation = -0.00478 * sinOf(node), aberration = -0.00569;
    const double longitude = 280.46646 + t * (36000.76983 + t * 0.0003032) + centre + perturbed + aberration + nutation;
    const double obliquity = 23.4392911 - 0.0130042 * t + 0.00256 * cosOf(node);
    const double days = day - epoch2000, centuries = days / daysOfCentury;
    return {std::atan2(cosOf(obliquity) * sinOf(longitude), cosOf(longitude)),
            std::asin(sinOf(obliquity) * sinOf(longitude)),
            280.46061837 + 360.98564736629 * days + 0.000387933 * centuries * centuries + nutation * cosOf(obliquity)};
}

} // namespace

SunPosition sunPosition(const PlaceOnEarth& place, const LocalTime& time) {
    const Equatorial sun = sunAt(julianDay(time));
    const double hourAngle = (sun.siderealTime + place.longitude) * radiansOfDegree - sun.rightAscension;
    const double sinDeclination = std::sin(sun.declination), cosDeclination = std::cos(sun.declination);
    const double sinLatitude = sinOf(place.latitude), cosLatitude = cosOf(place.latitude);
    const double east = -cosDeclination * std::sin(hourAngle);
    const double north = cosLatitude * sinDeclination - sinLatitude * cosDeclination * std::cos(hourAngle);
    const double up = sinLatitude * sinDeclination + cosLatitude * cosDeclination * std::cos(hourAngle);
    const double elevation = std::atan2(up, std::hypot(east, north));
    constexpr double parallax = 8.794 / 3600 * radiansOfDegree;
    return {std::atan2(east, north), elevation - parallax * std::cos(elevation)};
}

double sunNearness(const LocalTime& time) {
    const double days = julianDay(time) - julianDay({time.year, 1, 1, 0, time.zone});
    const double turn = 2 * std::numbers::pi * days / 365;
    return 1.000110 + 0.034221 * std::cos(turn) + 0.001280 * std::sin(turn) + 0.000719 * std::cos(2 * turn) +
           0.000077 * std::sin(2 * turn);
}

double refraction(double elevation, double pressure, double temperature) {
    const double degrees = elevation / radiansOfDegree;
    constexpr double radius = 0.26667, atHorizon = 0.5667; // of the sun's disc; of light (SPA, section 3.14)
    if (degrees < -(radius + atHorizon)) return 0;
    return pressure / 1010 * 283 / (273 + temperature) * 1.02 /
           (60 * std::tan((degrees + 10.3 / (degrees + 5.11)) * radiansOfDegree)) * radiansOfDegree;
}

glm::dvec3 towards(const SunPosition& sun) {
    const double across = std::cos(sun.elevation);
    return {across * std::sin(sun.azimuth), across * std::cos(sun.azimuth), std::sin(sun.elevation)};
}

} // namespace quasilux
