#include "output/meter_reading.h"

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

nlohmann::json meterJson(const RenderRecord& record, const FilmImage& image) {
    const bool units = record.settings.photometric;
    const MeterReading reading = meanReading(image, units);
    nlohmann::json components = nlohmann::json::object();
    for (unsigned k = 0; k < FILM_COMPONENTS; ++k)
        if (!image.components[k].empty()) components[componentName(k)] = reading.components[k];
    nlohmann::json json{{"quantity", quantityName(record.meter)},
                        {"unit", valueUnit(record.meter, units)},
                        {"value", reading.value},
                        {"standardError", nullptr},
                        {"components", components}};
    const std::string key = isIrradiance(record.meter) ? "illuminance" : "luminance";
    json[key] = reading.photometricValue;
    json[key + "StandardError"] = nullptr;
    if (image.passes > 1) { // one pass gives no estimate of the error
        json["standardError"] = reading.standardError;
        json[key + "StandardError"] = reading.photometricStandardError;
    }
    return json;
}

std::string meterText(const RenderRecord& record, const FilmImage& image) {
    const bool units = record.settings.photometric;
    const MeterReading reading = meanReading(image, units);
    const auto line = [&](const char* what, double value, double error, const char* unit) {
        const std::string spread = image.passes > 1 ? fmt::format(" +- {:.2g}", error) : "";
        return fmt::format("{} {:.6g}{} {}\n", what, value, spread, unit);
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
    return text;
}

} // namespace quasilux
