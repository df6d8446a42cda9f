#include "output/meter_reading.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

using Triple = std::array<double, 3>;

Triple tripleAt(const std::vector<float>& values, size_t pixel) {
    if (values.empty()) return {};
    return {values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]};
}

void addShare(Triple& sum, const Triple& value, double share) {
    for (size_t c = 0; c < 3; ++c) sum[c] += share * value[c];
}

const char* valueUnit(MeterKind meter, bool photometricUnits) {
    if (photometricUnits) return isIrradiance(meter) ? "lm/m2" : "cd/m2";
    return isIrradiance(meter) ? "W/m2" : "W/(sr m2)";
}

} // namespace

double photometric(const std::array<double, 3>& rgb, bool unitsArePhotometric) {
    const double y = luminanceOf(rgb[0], rgb[1], rgb[2]);
    return unitsArePhotometric ? y : luminousEfficacy * y;
}

const char* quantityName(MeterKind meter) { return isIrradiance(meter) ? "irradiance" : "radiance"; }

MeterReading readingOf(const FilmImage& image, size_t pixel, bool unitsArePhotometric) {
    MeterReading reading;
    reading.value = tripleAt(image.radiance, pixel);
    reading.standardError = tripleAt(image.standardError, pixel);
    for (size_t k = 0; k < FILM_COMPONENTS; ++k) reading.components[k] = tripleAt(image.components[k], pixel);
    reading.photometricValue = photometric(reading.value, unitsArePhotometric);
    reading.photometricStandardError = photometric(reading.standardError, unitsArePhotometric);
    return reading;
}

MeterReading meanReading(const FilmImage& image, bool unitsArePhotometric) {
    const size_t pixels = image.radiance.size() / 3;
    const double share = 1.0 / static_cast<double>(pixels);
    MeterReading mean;
    for (size_t k = 0; k < pixels; ++k) {
        const MeterReading here = readingOf(image, k, unitsArePhotometric);
        addShare(mean.value, here.value, share);
        addShare(mean.standardError, here.standardError, share);
        for (size_t c = 0; c < FILM_COMPONENTS; ++c) addShare(mean.components[c], here.components[c], share);
    }
    mean.photometricValue = photometric(mean.value, unitsArePhotometric);
    mean.photometricStandardError = photometric(mean.standardError, unitsArePhotometric);
    return mean;
}

namespace {

double errorOfRatio(const MeterReading& over, double under, double underError) {
    if (!(over.photometricValue > 0 && under > 0)) return 0;
    return over.photometricValue / under *
           std::hypot(over.photometricStandardError / over.photometricValue, underError / under);
}

/// An error, or null after a single pass, which gives no estimate of it.
template <typename Value>
nlohmann::json known(const FilmImage& image, const Value& error) {
    return image.passes > 1 ? nlohmann::json(error) : nlohmann::json();
}

nlohmann::json gridJson(const FilmImage& image, bool units) {
    const GridFigures figures = gridFigures(image, units);
    return {{"points", image.radiance.size() / 3},
            {"minimum", figures.minimum.photometricValue},
            {"minimumStandardError", known(image, figures.minimum.photometricStandardError)},
            {"maximum", figures.maximum.photometricValue},
            {"maximumStandardError", known(image, figures.maximum.photometricStandardError)},
            {"U0", figures.overall},
            {"U0StandardError", known(image, figures.overallStandardError)},
            {"Ud", figures.diversity},
            {"UdStandardError", known(image, figures.diversityStandardError)}};
}

} // namespace

GridFigures gridFigures(const FilmImage& image, bool unitsArePhotometric) {
    GridFigures found;
    for (size_t k = 0; k < image.radiance.size() / 3; ++k) {
        const MeterReading here = readingOf(image, k, unitsArePhotometric);
        if (k == 0 || here.photometricValue < found.minimum.photometricValue) found.minimum = here;
        if (k == 0 || here.photometricValue > found.maximum.photometricValue) found.maximum = here;
    }
    const MeterReading mean = meanReading(image, unitsArePhotometric);
    found.mean = mean.photometricValue;
    found.meanStandardError = mean.photometricStandardError;
    if (!(found.mean > 0)) return found;
    found.overall = found.minimum.photometricValue / found.mean;
    found.overallStandardError = errorOfRatio(found.minimum, found.mean, found.meanStandardError);
    found.diversity = found.minimum.photometricValue / found.maximum.photometricValue;
    found.diversityStandardError =
        errorOfRatio(found.minimum, found.maximum.photometricValue, found.maximum.photometricStandardError);
    return found;
}

std::string errorText(const FilmImage& image, double error) {
    return image.passes > 1 ? fmt::format(" +- {:.2g}", error) : "";
}

nlohmann::json meterJson(const RenderRecord& record, const FilmImage& image) {
    const bool units = record.settings.photometric;
    const MeterReading reading = meanReading(image, units);
    nlohmann::json components = nlohmann::json::object();
    for (unsigned k = 0; k < FILM_COMPONENTS; ++k)
        if (!image.components[k].empty()) components[componentName(k)] = reading.components[k];
    nlohmann::json json{{"quantity", quantityName(record.meter)},
                        {"unit", valueUnit(record.meter, units)},
                        {"value", reading.value},
                        {"standardError", known(image, reading.standardError)},
                        {"components", components}};
    const std::string key = isIrradiance(record.meter) ? "illuminance" : "luminance";
    json[key] = reading.photometricValue;
    json[key + "StandardError"] = known(image, reading.photometricStandardError);
    if (record.unobstructedIlluminance) {
        const double percent = 100 / *record.unobstructedIlluminance;
        json["unobstructedIlluminance"] = *record.unobstructedIlluminance;
        json["daylightFactor"] = percent * reading.photometricValue;
        json["daylightFactorStandardError"] = known(image, percent * reading.photometricStandardError);
    }
    if (record.meter == MeterKind::grid) json["grid"] = gridJson(image, units);
    return json;
}

std::string meterText(const RenderRecord& record, const FilmImage& image) {
    const bool units = record.settings.photometric;
    const MeterReading reading = meanReading(image, units);
    const auto line = [&](const char* what, double value, double error, const char* unit) {
        return fmt::format("{} {:.6g}{} {}\n", what, value, errorText(image, error), unit);
    };
    std::string text;
    if (image.radiance.size() > 3) text += fmt::format("mean over {} pixels:\n", image.radiance.size() / 3);
    const char* names[3] = {" R", " G", " B"};
    for (size_t c = 0; c < 3; ++c)
        text += line((quantityName(record.meter) + std::string(names[c])).c_str(), reading.value[c],
                     reading.standardError[c], valueUnit(record.meter, units));
    const bool irradiance = isIrradiance(record.meter);
    text += line(irradiance ? "illuminance" : "luminance", reading.photometricValue, reading.photometricStandardError,
                 irradiance ? "lx" : "cd/m2");
    if (record.unobstructedIlluminance) {
        const double percent = 100 / *record.unobstructedIlluminance;
        text += line("daylight factor", percent * reading.photometricValue, percent * reading.photometricStandardError,
                     fmt::format("% of {:.6g} lx", *record.unobstructedIlluminance).c_str());
    }
    if (record.meter == MeterKind::grid) {
        const GridFigures figures = gridFigures(image, units);
        text += line("minimum", figures.minimum.photometricValue, figures.minimum.photometricStandardError, "lx");
        text += line("uniformity U0", figures.overall, figures.overallStandardError, "(minimum / mean)");
        text += line("diversity Ud", figures.diversity, figures.diversityStandardError, "(minimum / maximum)");
    }
    return text;
}

} // namespace quasilux
