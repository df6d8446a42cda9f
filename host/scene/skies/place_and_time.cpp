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

double numberWithin(Properties& properties, const std::string& name, double missing, double lowest, double highest) {
    const double value = properties.number(name, missing);
    if (!(value >= lowest && value <= highest))
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; expected {} to {}.", name, value, lowest, highest));
    return value;
}

int integerWithin(Properties& properties, const std::string& name, int64_t missing, int64_t lowest, int64_t highest) {
    const int64_t value = properties.integer(name, missing);
    if (value < lowest || value > highest)
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; expected {} to {}.", name, value, lowest, highest));
    return static_cast<int>(value);
}

int daysOf(int month, int year) {
    constexpr std::array<int, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool isLeap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return days.at(static_cast<size_t>(month) - 1) + (month == 2 && isLeap ? 1 : 0);
}

LocalTime readTime(Properties& properties) {
    LocalTime time;
    time.zone = numberWithin(properties, "timezone", 9, -14, 14);
    time.year = integerWithin(properties, "year", 2010, 1950, 2100);
    time.month = integerWithin(properties, "month", 7, 1, 12);
    time.day = integerWithin(properties, "day", 10, 1, daysOf(time.month, time.year));
    time.hour = numberWithin(properties, "hour", 15, 0, 24) + numberWithin(properties, "minute", 0, 0, 60) / 60 +
                numberWithin(properties, "second", 0, 0, 60) / 3600;
    return time;
}

PlaceOnEarth readPlace(Properties& properties) {
    return {numberWithin(properties, "latitude", 35.6894, -90, 90),
            numberWithin(properties, "longitude", 139.6917, -180, 180)};
}

void checkPlaceAndTimeAreWhole(Properties& properties, const std::string& given) {
    if (properties.has("sun_direction"))
        throw InputError(properties.where(given),
                         fmt::format("{} has both sun_direction and {}; keep the direction, or place and time.",
                                     properties.describe(), given));
    for (size_t k = 0; k < neededNames; ++k)
        if (!properties.has(placeAndTimeNames.at(k)))
            throw InputError(properties.where(given),
                             fmt::format("{} has {} but no {}; the sun's place needs latitude, longitude, timezone, "
                                         "year, month, day and hour.",
                                         properties.describe(), given, placeAndTimeNames.at(k)));
}

} // namespace

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
    checkSunIsUp(properties, std::asin(std::clamp(sun.towards.z, -1.0, 1.0)));
    return sun;
}

void checkSunIsUp(Properties& properties, double elevation) {
    if (elevation >= 0) return;
    const std::string name = properties.has("sun_direction") ? "sun_direction" : givenPlaceOrTime(properties);
    throw InputError(name.empty() ? properties.element().where : properties.where(name),
                     fmt::format("{}: the sun is {:.4g} degrees below the horizon, where the sky has no model. Choose "
                                 "another time or direction, or remove the emitter.",
                                 properties.describe(), -elevation * 180 / std::numbers::pi));
}

} // namespace quasilux
