#include "output/meter_reading.h"

#include <algorithm>
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
    for (size_t k = 0; k < FILM_COMPONENTS; ++k) reading.components[k] = tripleAt(image.components[k].radiance, pixel);
    reading.photometricValue = photometric(reading.value, unitsArePhotometric);
    reading.photometricStandardError = photometric(reading.standardError, unitsArePhotometric);
    return reading;
}

PixelRange allPixels(const FilmImage& image) { return {0, image.radiance.size() / 3}; }

std::vector<PixelRange> rangesOf(const std::vector<IlluminanceGrid>& grids) {
    std::vector<PixelRange> ranges;
    size_t first = 0;
    for (const IlluminanceGrid& grid : grids) {
        ranges.push_back({first, grid.points()});
        first += grid.points();
    }
    return ranges;
}

MeterReading meanReading(const FilmImage& image, PixelRange range, bool unitsArePhotometric) {
    const double share = 1.0 / static_cast<double>(range.count);
    MeterReading mean;
    for (size_t k = range.first; k < range.first + range.count; ++k) {
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
    return image.isErrorKnown() ? nlohmann::json(error) : nlohmann::json();
}

/// Of one meter, or one grid.
class MeterWriter {
public:
    MeterWriter(const RenderRecord& record, const FilmImage& image)
        : record_(record), image_(image), isPhotometric_(record.settings.photometric), ranges_(rangesOf(record.grids)) {
    }

    nlohmann::json json() const {
        if (ranges_.size() < 2) {
            nlohmann::json one = readingJson(ranges_.empty() ? allPixels(image_) : ranges_.front());
            one.update(quantityJson());
            if (!ranges_.empty()) one["grid"] = gridJson(0);
            return one;
        }
        nlohmann::json all = quantityJson();
        all["grids"] = nlohmann::json::array();
        for (size_t k = 0; k < ranges_.size(); ++k) {
            nlohmann::json one = readingJson(ranges_[k]);
            one["name"] = record_.grids[k].name;
            one.update(gridJson(k));
            all["grids"].push_back(one);
        }
        return all;
    }

    std::string text() const {
        if (ranges_.empty()) return readingText(allPixels(image_));
        std::string text;
        for (size_t k = 0; k < ranges_.size(); ++k) {
            if (ranges_.size() > 1) text += record_.grids[k].name + ", ";
            text += readingText(ranges_[k]) + gridText(k);
        }
        return text;
    }

private:
    const IlluminanceGrid& grid(size_t k) const { return record_.grids[k]; }
    bool isCylindrical(size_t k) const { return grid(k).kind == IlluminanceKind::cylindrical; }

    nlohmann::json quantityJson() const {
        return {{"quantity", quantityName(record_.meter)}, {"unit", valueUnit(record_.meter, isPhotometric_)}};
    }

    nlohmann::json readingJson(PixelRange range) const {
        const MeterReading reading = meanReading(image_, range, isPhotometric_);
        nlohmann::json byClass = nlohmann::json::object();
        for (unsigned k = 0; k < FILM_COMPONENTS; ++k)
            if (!image_.components[k].radiance.empty()) byClass[componentName(k)] = reading.components[k];
        nlohmann::json json{
            {"value", reading.value}, {"standardError", known(image_, reading.standardError)}, {"components", byClass}};
        const std::string key = isIrradiance(record_.meter) ? "illuminance" : "luminance";
        json[key] = reading.photometricValue;
        json[key + "StandardError"] = known(image_, reading.photometricStandardError);
        if (record_.unobstructedIlluminance) {
            const double percent = 100 / *record_.unobstructedIlluminance;
            json["unobstructedIlluminance"] = *record_.unobstructedIlluminance;
            json["daylightFactor"] = percent * reading.photometricValue;
            json["daylightFactorStandardError"] = known(image_, percent * reading.photometricStandardError);
        }
        return json;
    }

    nlohmann::json gridJson(size_t k) const {
        const GridFigures figures = gridFigures(image_, ranges_[k], isPhotometric_);
        nlohmann::json json{{"points", ranges_[k].count},
                            {"kind", isCylindrical(k) ? "cylindrical" : "planar"},
                            {"minimum", figures.minimum.photometricValue},
                            {"minimumStandardError", known(image_, figures.minimum.photometricStandardError)},
                            {"maximum", figures.maximum.photometricValue},
                            {"maximumStandardError", known(image_, figures.maximum.photometricStandardError)},
                            {"U0", figures.overall},
                            {"U0StandardError", known(image_, figures.overallStandardError)},
                            {"Ud", figures.diversity},
                            {"UdStandardError", known(image_, figures.diversityStandardError)}};
        if (const auto twin = horizontalTwin(record_.grids, k)) {
            const Modelling found = modelling(image_, ranges_[k], ranges_[*twin], isPhotometric_);
            json["modelling"] = {{"ofMeans", found.ofMeans},
                                 {"ofMeansStandardError", known(image_, found.ofMeansStandardError)},
                                 {"minimum", found.least},
                                 {"maximum", found.most}};
        }
        return json;
    }

    std::string line(const std::string& what, double value, double error, const std::string& unit) const {
        return fmt::format("{} {:.6g}{} {}\n", what, value, errorText(image_, error), unit);
    }

    std::string readingText(PixelRange range) const {
        const MeterReading reading = meanReading(image_, range, isPhotometric_);
        std::string text;
        if (range.count > 1) text += fmt::format("mean over {} pixels:\n", range.count);
        const char* names[3] = {" R", " G", " B"};
        for (size_t c = 0; c < 3; ++c)
            text += line(quantityName(record_.meter) + std::string(names[c]), reading.value[c],
                         reading.standardError[c], valueUnit(record_.meter, isPhotometric_));
        const bool irradiance = isIrradiance(record_.meter);
        text += line(irradiance ? "illuminance" : "luminance", reading.photometricValue,
                     reading.photometricStandardError, irradiance ? "lx" : "cd/m2");
        if (record_.unobstructedIlluminance) {
            const double percent = 100 / *record_.unobstructedIlluminance;
            text +=
                line("daylight factor", percent * reading.photometricValue, percent * reading.photometricStandardError,
                     fmt::format("% of {:.6g} lx", *record_.unobstructedIlluminance));
        }
        return text;
    }

    std::string gridText(size_t k) const {
        const GridFigures figures = gridFigures(image_, ranges_[k], isPhotometric_);
        std::string text =
            line("minimum", figures.minimum.photometricValue, figures.minimum.photometricStandardError, "lx") +
            line("uniformity U0", figures.overall, figures.overallStandardError, "(minimum / mean)") +
            line("diversity Ud", figures.diversity, figures.diversityStandardError, "(minimum / maximum)");
        if (const auto twin = horizontalTwin(record_.grids, k)) {
            const Modelling found = modelling(image_, ranges_[k], ranges_[*twin], isPhotometric_);
            text += line("modelling", found.ofMeans, found.ofMeansStandardError,
                         fmt::format("(cylindrical / '{}'; of points {:.3g} to {:.3g})", grid(*twin).name, found.least,
                                     found.most));
        }
        return text;
    }

    const RenderRecord& record_;
    const FilmImage& image_;
    bool isPhotometric_;
    std::vector<PixelRange> ranges_;
};

} // namespace

GridFigures gridFigures(const FilmImage& image, PixelRange range, bool unitsArePhotometric) {
    GridFigures found;
    for (size_t k = 0; k < range.count; ++k) {
        const MeterReading here = readingOf(image, range.first + k, unitsArePhotometric);
        if (k == 0 || here.photometricValue < found.minimum.photometricValue) found.minimum = here;
        if (k == 0 || here.photometricValue > found.maximum.photometricValue) found.maximum = here;
    }
    const MeterReading mean = meanReading(image, range, unitsArePhotometric);
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

std::optional<size_t> horizontalTwin(const std::vector<IlluminanceGrid>& grids, size_t cylindrical) {
    const IlluminanceGrid& one = grids[cylindrical];
    if (one.kind != IlluminanceKind::cylindrical) return std::nullopt;
    const auto isTwin = [&](const IlluminanceGrid& other) {
        return other.kind == IlluminanceKind::planar && other.origin == one.origin && other.edgeU == one.edgeU &&
               other.edgeV == one.edgeV && other.nx == one.nx && other.ny == one.ny;
    };
    const auto found = std::find_if(grids.begin(), grids.end(), isTwin);
    if (found == grids.end()) return std::nullopt;
    return static_cast<size_t>(found - grids.begin());
}

Modelling modelling(const FilmImage& image, PixelRange cylindrical, PixelRange horizontal, bool unitsArePhotometric) {
    Modelling found;
    bool isFirst = true;
    for (size_t k = 0; k < cylindrical.count; ++k) {
        const double under = readingOf(image, horizontal.first + k, unitsArePhotometric).photometricValue;
        if (!(under > 0)) continue;
        const double ratio = readingOf(image, cylindrical.first + k, unitsArePhotometric).photometricValue / under;
        found.least = isFirst ? ratio : std::min(found.least, ratio);
        isFirst = false;
        found.most = std::max(found.most, ratio);
    }
    const MeterReading over = meanReading(image, cylindrical, unitsArePhotometric),
                       under = meanReading(image, horizontal, unitsArePhotometric);
    if (!(under.photometricValue > 0)) return found;
    found.ofMeans = over.photometricValue / under.photometricValue;
    found.ofMeansStandardError = errorOfRatio(over, under.photometricValue, under.photometricStandardError);
    return found;
}

std::string errorText(const FilmImage& image, double error) {
    return image.isErrorKnown() ? fmt::format(" +- {:.2g}", error) : "";
}

nlohmann::json meterJson(const RenderRecord& record, const FilmImage& image) {
    return MeterWriter(record, image).json();
}

std::string meterText(const RenderRecord& record, const FilmImage& image) { return MeterWriter(record, image).text(); }

} // namespace quasilux
