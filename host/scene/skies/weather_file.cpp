#include "scene/skies/weather_file.h"

#include "scene/goniograms/file_numbers.h"
#include "scene/xml/numbers.h"

#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace quasilux {

namespace {

// EnergyPlus, Auxiliary Programs: fields of a line of data, and of the line LOCATION, from 0 on.
enum DataField : size_t {
    yearField,
    monthField,
    dayField,
    hourField,
    dewPointField = 7,
    directField = 14,
    diffuseField
};
enum LocationField : size_t { latitudeField = 6, longitudeField, zoneField };
constexpr size_t recordsField = 2; // of the line DATA PERIODS

constexpr double missingRadiation = 9999, missingDewPoint = 99.9;

struct WeatherLine {
    const std::string& path;
    int number;
    std::vector<std::string_view> fields;

    SourceLocation where() const { return {path, number, 1}; }
    double at(size_t field, std::string_view what, double lowest, double highest) const {
        if (field >= fields.size())
            throw InputError(where(), fmt::format("the line has {} fields; expected {} as number {}.", fields.size(),
                                                  what, field + 1));
        const double value = parseNumber(fields[field], where(), what);
        if (!(value >= lowest && value <= highest))
            throw InputError(where(), fmt::format("{} is {}; expected {} to {}.", what, value, lowest, highest));
        return value;
    }
    int wholeAt(size_t field, std::string_view what, int lowest, int highest) const {
        return static_cast<int>(at(field, what, lowest, highest));
    }
};

std::vector<std::string_view> splitFields(std::string_view line) {
    std::vector<std::string_view> fields;
    for (size_t from = 0;;) {
        const size_t comma = line.find(',', from);
        fields.push_back(line.substr(from, comma == std::string_view::npos ? comma : comma - from));
        if (comma == std::string_view::npos) return fields;
        from = comma + 1;
    }
}

double radiationAt(const WeatherLine& line, size_t field, const char* what) {
    const double value = line.at(field, what, 0, missingRadiation);
    if (value == missingRadiation)
        throw InputError(line.where(), fmt::format("{} is missing (9999) in this hour.", what));
    return value;
}

} // namespace

WeatherHour readWeatherHour(const std::string& path, const std::string& content, int month, int day, int hour,
                            const SourceLocation& where) {
    constexpr size_t headLines = 8;
    const std::vector<std::string_view> lines = splitLines(content);
    const WeatherLine location{path, 1, splitFields(lines.empty() ? std::string_view() : lines.front())};
    if (location.fields.front() != "LOCATION")
        throw InputError(location.where(), "not an EnergyPlus weather file: its first line begins with LOCATION.");
    WeatherHour found;
    found.place.latitude = location.at(latitudeField, "the latitude", -90, 90);
    found.place.longitude = location.at(longitudeField, "the longitude", -180, 180);
    found.time.zone = location.at(zoneField, "the time zone", -14, 14);
    if (lines.size() >= headLines)
        WeatherLine{path, headLines, splitFields(lines[headLines - 1])}.wholeAt(recordsField,
                                                                                "the number of records an hour", 1, 1);
    for (size_t k = headLines; k < lines.size(); ++k) {
        if (lines[k].empty()) continue;
        const WeatherLine line{path, static_cast<int>(k) + 1, splitFields(lines[k])};
        if (line.wholeAt(monthField, "the month", 1, 12) != month || line.wholeAt(dayField, "the day", 1, 31) != day ||
            line.wholeAt(hourField, "the hour", 1, 24) != hour)
            continue;
        found.time.year = line.wholeAt(yearField, "the year", 1950, 2100);
        found.time.month = month;
        found.time.day = day;
        found.time.hour = hour - 0.5;
        found.radiation.directNormal = radiationAt(line, directField, "the direct normal radiation");
        found.radiation.diffuseHorizontal = radiationAt(line, diffuseField, "the diffuse horizontal radiation");
        const double dewPoint = line.at(dewPointField, "the dew point", -90, missingDewPoint);
        if (dewPoint != missingDewPoint) found.radiation.dewPoint = dewPoint;
        return found;
    }
    throw InputError(where, fmt::format("'{}' has no hour {} of day {} of month {}.", path, hour, day, month));
}

} // namespace quasilux
