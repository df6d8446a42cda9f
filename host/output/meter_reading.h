// What a meter has measured, in radiometric and photometric units.
#pragma once

#include "output/render_record.h"
#include "scene/photometric_units.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace quasilux {

/// Photometric value of linear sRGB: 683 lm/W times luminance with the weights of sRGB to CIE XYZ (IEC 61966-2-1); the
/// weights alone where the scene's units are photometric already. Irradiance gives lux, radiance cd/m^2.
double photometric(const std::array<double, 3>& rgb, bool unitsArePhotometric);

/// A pixel, or the mean over all of them.
struct MeterReading {
    std::array<double, 3> value{}; ///< R, G, B: irradiance in W/m^2, of a radiancemeter radiance in W sr^-1 m^-2
    std::array<double, 3> standardError{}; ///< of `value`
    std::array<std::array<double, 3>, FILM_COMPONENTS> components{};
    double photometricValue = 0;         ///< lx, or cd/m^2
    double photometricStandardError = 0; ///< an upper bound, exact where the channels rise and fall together
};

MeterReading readingOf(const FilmImage& image, size_t pixel, bool unitsArePhotometric);
/// Some of a film's pixels, one after the other.
struct PixelRange {
    size_t first = 0, count = 0;
};
PixelRange allPixels(const FilmImage& image);
/// Of the grids that were measured together.
std::vector<PixelRange> rangesOf(const std::vector<IlluminanceGrid>& grids);

/// Mean over pixels; its standard error is the mean of those of the pixels, which share photons: an upper bound.
MeterReading meanReading(const FilmImage& image, PixelRange range, bool unitsArePhotometric);

/// What norms ask of the points of a grid: lx, or percent of daylight factors, which have the same ratios.
struct GridFigures {
    MeterReading minimum, maximum; ///< of the points
    double mean = 0, meanStandardError = 0;
    double overall = 0, overallStandardError = 0;     ///< U0: minimum over mean (EN 12464-1)
    double diversity = 0, diversityStandardError = 0; ///< Ud: minimum over maximum
};
/// Errors of ratios as though those of their terms were independent. The minimum of noisy values is too low by about
/// their noise.
GridFigures gridFigures(const FilmImage& image, PixelRange range, bool unitsArePhotometric);

/// Of the cylindrical and the horizontal illuminance (EN 12464-1): their ratio.
struct Modelling {
    double ofMeans = 0, ofMeansStandardError = 0; ///< as though the two were independent
    double least = 0, most = 0;                   ///< of the points
};
/// The grid of horizontal illuminance that has the same points as this one of cylindrical illuminance, if any.
std::optional<size_t> horizontalTwin(const std::vector<IlluminanceGrid>& grids, size_t cylindrical);
Modelling modelling(const FilmImage& image, PixelRange cylindrical, PixelRange horizontal, bool unitsArePhotometric);

/// "irradiance" or "radiance".
const char* quantityName(MeterKind meter);

/// " +- ERROR", or nothing after a single pass, which gives no estimate of it.
std::string errorText(const FilmImage& image, double error);

/// Keys: docs/reference/command-line.md.
nlohmann::json meterJson(const RenderRecord& record, const FilmImage& image);
/// A few lines for people.
std::string meterText(const RenderRecord& record, const FilmImage& image);

} // namespace quasilux
