#include "scene/skies/weather_file.h"

#include "scene/goniograms/file_numbers.h"
#include "scene/xml/numbers.h"

#include <algorithm>
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

constexpr std::string_view locationWord = "LOCATION", dataPeriods = "DATA PERIODS"; // begin lines
constexpr double missingRadiation = 9999, missingDewPoint = 99.9;                   // or more
constexpr double mostOfField = 999999;
constexpr int firstYear = 1950, lastYear = 2100, midYear = 2006; // that sun positions are known of; between leap years

struct WeatherLine {
    const std::string& path;
    int number;
    std::vector<std::string_view> fields;

    SourceLocation where() const { return {path, number, 1}; }
    bool isBlank(size_t field) const {
        return field < fields.size() && fields[field].find_first_not_of(" \t") == std::string_view::npos;
    }
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
    const double value = line.at(field, what, 0, mostOfField);
    if (value >= missingRadiation)
        throw InputError(line.where(), fmt::format("{} is missing ({:g}) in this hour; choose another.", what, value));
    return value;
}

/// Typical years are put together from months of several; some files say none, as 0 or 9999.
int yearAt(const WeatherLine& line) {
    const double year = line.isBlank(yearField) ? 0 : line.at(yearField, "the year", 0, 9999);
    return year >= firstYear && year <= lastYear ? static_cast<int>(year) : midYear;
}

/// Index of the first line of hours, after DATA PERIODS: the line 8, or a later one where a comment has several lines.
size_t firstHour(const std::string& path, const std::vector<std::string_view>& lines) {
    const auto found = std::find_if(lines.begin(), lines.end(), [](std::string_view line) {
        return isWord(line.substr(0, dataPeriods.size()), dataPeriods);
    });
    const int number = static_cast<int>(found - lines.begin()) + 1;
    if (found == lines.end())
        throw InputError(SourceLocation{path, 1, 1},
                         "the file has no line DATA PERIODS, after which hours are expected; "
                         "it is no EnergyPlus weather file, or is cut off.");
    const int records =
        WeatherLine{path, number, splitFields(*found)}.wholeAt(recordsField, "the number of records an hour", 1, 60);
    if (records != 1)
        throw InputError(SourceLocation{path, number, 1},
                         fmt::format("the file has {} records an hour; expected one. Take a file of hours.", records));
    return static_cast<size_t>(number);
}

} // namespace

WeatherHour readWeatherHour(const std::string& path, const std::string& content, int month, int day, int hour,
                            const SourceLocation& where) {
    const std::vector<std::string_view> lines = splitLines(content);
    const WeatherLine location{path, 1, splitFields(lines.empty() ? std::string_view() : lines.front())};
    if (!isWord(location.fields.front().substr(0, locationWord.size()), locationWord))
        throw InputError(location.where(), "not an EnergyPlus weather file: its first line begins with LOCATION.");
    WeatherHour found;
    found.place.latitude = location.at(latitudeField, "the latitude", -90, 90);
    found.place.longitude = location.at(longitudeField, "the longitude", -180, 180);
    found.time.zone = location.at(zoneField, "the time zone", -14, 14);
    for (size_t k = firstHour(path, lines); k < lines.size(); ++k) {
        if (lines[k].empty()) continue;
        const WeatherLine line{path, static_cast<int>(k) + 1, splitFields(lines[k])};
        if (line.wholeAt(monthField, "the month", 1, 12) != month || line.wholeAt(dayField, "the day", 1, 31) != day ||
            line.wholeAt(hourField, "the hour", 1, 24) != hour)
            continue;
        found.time.year = yearAt(line);
        found.time.month = month;
        found.time.day = day;
        found.time.hour = hour - 0.5;
        found.radiation.directNormal = radiationAt(line, directField, "the direct normal radiation");
        found.radiation.diffuseHorizontal = radiationAt(line, diffuseField, "the diffuse horizontal radiation");
        if (line.isBlank(dewPointField)) return found;
        const double dewPoint = line.at(dewPointField, "the dew point", -90, mostOfField);
        if (dewPoint < missingDewPoint) found.radiation.dewPoint = dewPoint;
        return found;
    }
    throw InputError(where, fmt::format("'{}' has no hour {} of day {} of month {}.", path, hour, day, month));
}

} // namespace quasilux
