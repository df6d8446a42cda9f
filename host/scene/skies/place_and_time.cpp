#include "scene/skies/place_and_time.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr std::array<const char*, 9> placeAndTimeNames = {"latitude", "longitude", "timezone", "year",  "month",
                                                          "day",      "hour",      "minute",   "second"};
constexpr size_t neededNames = 7; // without minute and second

int daysOf(int month, int year) {
    constexpr std::array<int, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool isLeap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return days.at(static_cast<size_t>(month) - 1) + (month == 2 && isLeap ? 1 : 0);
}

LocalTime readTime(Properties& properties) {
    LocalTime time;
    time.zone = properties.numberWithin("timezone", 9, -14, 14);
    time.year = properties.integerWithin("year", 2010, 1950, 2100);
    time.month = properties.integerWithin("month", 7, 1, 12);
    time.day = properties.integerWithin("day", 10, 1, daysOf(time.month, time.year));
    time.hour = properties.numberWithin("hour", 15, 0, 24) + properties.numberWithin("minute", 0, 0, 60) / 60 +
                properties.numberWithin("second", 0, 0, 60) / 3600;
    return time;
}

PlaceOnEarth readPlace(Properties& properties) {
    return {properties.numberWithin("latitude", 35.6894, -90, 90),
            properties.numberWithin("longitude", 139.6917, -180, 180)};
}

void checkPlaceAndTimeAreWhole(Properties& properties, const std::string& given) {
    if (properties.has("sun_direction")) refuseBesideDirection(properties, given);
    for (size_t k = 0; k < neededNames; ++k)
        if (!properties.has(placeAndTimeNames.at(k)))
            throw InputError(properties.where(given),
                             fmt::format("{} has {} but no {}; the sun's place needs latitude, longitude, timezone, "
                                         "year, month, day and hour.",
                                         properties.describe(), given, placeAndTimeNames.at(k)));
}

} // namespace

void refuseBesideDirection(Properties& properties, const std::string& given) {
    throw InputError(properties.where(given),
                     fmt::format("{} has both sun_direction and {}; keep the direction, or place and time.",
                                 properties.describe(), given));
}

std::string givenPlaceOrTime(Properties& properties) {
    for (const char* name : placeAndTimeNames)
        if (properties.has(name)) return name;
    return {};
}

SunPosition readSunPosition(Properties& properties) {
    const PlaceOnEarth place = readPlace(properties);
    return sunPosition(place, readTime(properties));
}

SunOfMap sunOfMap(const PlaceOnEarth& place, const LocalTime& time) {
    constexpr double pressure = 1010, temperature = 10;
    SunPosition sun = sunPosition(place, time);
    sun.elevation += refraction(sun.elevation, pressure, temperature);
    return {towards(sun), sunNearness(time)};
}

SunOfMap readSunOfMap(Properties& properties) {
    const std::string given = givenPlaceOrTime(properties);
    SunOfMap sun;
    if (given.empty()) {
        sun.towards = properties.direction("sun_direction", sun.towards);
    } else {
        checkPlaceAndTimeAreWhole(properties, given);
        const PlaceOnEarth place = readPlace(properties);
        sun = sunOfMap(place, readTime(properties));
    }
    checkSunIsUp(properties, sun.towards);
    return sun;
}

void checkSunIsUp(Properties& properties, const glm::dvec3& towards) {
    if (towards.z >= 0) return;
    const double below = -std::asin(std::max(towards.z, -1.0)) * 180 / std::numbers::pi;
    const std::string name = properties.has("sun_direction") ? "sun_direction" : givenPlaceOrTime(properties);
    throw InputError(name.empty() ? properties.element().where : properties.where(name),
                     fmt::format("{}: the sun is {:.4g} degrees below the horizon, where the sky has no model. Choose "
                                 "another time or direction, or remove the emitter.",
                                 properties.describe(), below));
}

} // namespace quasilux
