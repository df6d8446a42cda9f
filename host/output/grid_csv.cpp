#include "output/grid_csv.h"

#include "output/atomic_file.h"
#include "output/meter_reading.h"

#include <cmath>
#include <fmt/ostream.h>
#include <sstream>

namespace quasilux {

namespace {

// Light that arrives has no component of emission seen: that is of cameras.
constexpr unsigned components = LIGHT_CLASSES;

void writeSettings(std::ostream& out, const RenderRecord& record) {
    const RenderSettings& settings = record.settings;
    const auto line = [&](const char* key, const auto& value) { fmt::print(out, "# {}: {}\n", key, value); };
    line("quasilux", record.version);
    record.forEachSetting(line);
    if (record.error.isKnown()) line("relativeError", record.error.sum());
    line("units", fmt::format("{}, irradiance in {}/m2{}", record.units(), settings.photometric ? "lm" : "W",
                              record.isPerNanometre ? "/nm" : ""));
    line("illuminance",
         settings.photometric ? "lx: 0.2126 R + 0.7152 G + 0.0722 B" : "lx: 683 lm/W (0.2126 R + 0.7152 G + 0.0722 B)");
}

void writeFigures(std::ostream& out, const RenderRecord& record, const FilmImage& image, size_t k,
                  const PixelRange& range) {
    const GridFigures figures = gridFigures(image, range, record.settings.photometric);
    const std::string begin = record.grids.size() > 1 ? record.grids[k].name + " " : "";
    const auto line = [&](const char* key, double value, double error, const char* unit) {
        fmt::print(out, "# {}{}: {:.6g}{}{}\n", begin, key, value, errorText(image, error), unit);
    };
    line("mean", figures.mean, figures.meanStandardError, " lx");
    line("minimum", figures.minimum.photometricValue, figures.minimum.photometricStandardError, " lx");
    line("maximum", figures.maximum.photometricValue, figures.maximum.photometricStandardError, " lx");
    line("U0", figures.overall, figures.overallStandardError, " (minimum / mean)");
    line("Ud", figures.diversity, figures.diversityStandardError, " (minimum / maximum)");
}

void writeNames(std::ostream& out, bool hasGridNames, bool hasDaylightFactor) {
    if (hasGridNames) out << "grid,";
    out << "i,j,x,y,z,nx,ny,nz,illuminance,illuminance_stderr";
    for (const char* channel : {"R", "G", "B"}) out << ",irradiance_" << channel;
    for (const char* channel : {"R", "G", "B"}) out << ",stderr_" << channel;
    for (unsigned c = 0; c < components; ++c)
        for (const char* channel : {"R", "G", "B"}) out << ',' << componentName(c) << '_' << channel;
    if (hasDaylightFactor) out << ",daylight_factor,daylight_factor_stderr";
    out << '\n';
}

void writeTriple(std::ostream& out, const std::array<double, 3>& value) {
    for (const double v : value) fmt::print(out, ",{:.9g}", v);
}

void writePoint(std::ostream& out, const IlluminanceGrid& grid, unsigned i, unsigned j, const MeterReading& reading,
                bool hasError, const std::optional<double>& unobstructed) {
    const glm::dvec3 p = grid.point(i, j), n = grid.normal();
    fmt::print(out, "{},{}", i, j);
    writeTriple(out, {p.x, p.y, p.z});
    writeTriple(out, {n.x, n.y, n.z});
    fmt::print(out, ",{:.9g},", reading.photometricValue);
    if (hasError) fmt::print(out, "{:.9g}", reading.photometricStandardError);
    writeTriple(out, reading.value);
    if (hasError)
        writeTriple(out, reading.standardError);
    else
        out << ",,,"; // one pass gives no estimate of the error
    for (unsigned c = 0; c < components; ++c) writeTriple(out, reading.components[c]);
    if (unobstructed) {
        fmt::print(out, ",{:.9g},", 100 * reading.photometricValue / *unobstructed);
        if (hasError) fmt::print(out, "{:.9g}", 100 * reading.photometricStandardError / *unobstructed);
    }
    out << '\n';
}

} // namespace

void writeGridCsv(const std::string& path, const FilmImage& image, const RenderRecord& record) {
    std::ostringstream out;
    writeSettings(out, record);
    const std::vector<PixelRange> ranges = rangesOf(record.grids);
    const bool hasNames = ranges.size() > 1;
    for (size_t k = 0; k < ranges.size(); ++k) writeFigures(out, record, image, k, ranges[k]);
    if (record.unobstructedIlluminance)
        fmt::print(out, "# daylightFactor: % of {:.9g} lx, free ground under the sky without sun and lamps\n",
                   *record.unobstructedIlluminance);
    writeNames(out, hasNames, record.unobstructedIlluminance.has_value());
    for (size_t k = 0; k < ranges.size(); ++k) {
        const IlluminanceGrid& grid = record.grids[k];
        for (unsigned j = 0; j < grid.ny; ++j)
            for (unsigned i = 0; i < grid.nx; ++i) {
                if (hasNames) out << grid.name << ',';
                const size_t pixel = ranges[k].first + size_t{j} * grid.nx + i;
                writePoint(out, grid, i, j, readingOf(image, pixel, record.settings.photometric), image.isErrorKnown(),
                           record.unobstructedIlluminance);
            }
    }
    writeText(path, out.str());
}

} // namespace quasilux
