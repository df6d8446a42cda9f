#include "cli/commands.h"

#include "cli/drawing_file.h"
#include "photometry/isolux.h"
#include "util/error.h"
#include "util/file_ending.h"
#include "util/messages.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

namespace fs = std::filesystem;

ValueScale givenScale(const FalseColourOptions& options) {
    const size_t colon = options.range.find(':');
    const ValueScale scale{std::stod(options.range.substr(0, colon)), std::stod(options.range.substr(colon + 1)),
                           options.logarithmic};
    if (options.logarithmic && !(scale.from > 0))
        throw InputError(
            fmt::format("--range {}: a logarithmic scale begins above 0; give a range such as 1:1000", options.range));
    return scale;
}

void requireImage(const FalseColourOptions& options) {
    if (!options.levels.empty())
        throw InputError("--levels: isolux lines are of grids; give a table, .csv, or leave --levels out");
    if (!options.grid.empty()) throw InputError("--grid: an image has none; give a grid's table, .csv");
    if (options.daylightFactor) throw InputError("--daylight-factor: an image has none; give a grid's table, .csv");
}

Drawing drawingOfGrid(const FalseColourOptions& options, const std::string& title) {
    if (options.photometric)
        throw InputError("--photometric: a grid's table is in lx already; leave --photometric out");
    if (options.efficacy) throw InputError("--efficacy: a grid's table is in lx already; leave --efficacy out");
    const GridValues grid = readGridTable(
        options.input, options.daylightFactor ? GridQuantity::daylightFactor : GridQuantity::illuminance, options.grid);
    const auto warning = warningOfUnits(grid.isPerNanometre, grid.unit, options.input);
    if (warning && !options.quiet) printWarning(*warning);
    const ValueScale scale = options.range.empty() ? scaleOfGrid(grid, options.logarithmic) : givenScale(options);
    return isoluxDrawing(grid, {parseColourMap(options.map), scale}, options.levels, title);
}

Drawing drawingOfImage(const FalseColourOptions& options, const std::string& title) {
    requireImage(options);
    const LuminanceImage image =
        readLuminance(options.input, options.photometric ? std::optional(1.0) : options.efficacy);
    if (!image.unitsWarning.empty() && !options.quiet) printWarning(image.unitsWarning);
    if (std::none_of(image.values.begin(), image.values.end(), [](float value) { return std::isfinite(value); }))
        throw InputError(options.input + ": no pixel is finite, so there is no luminance to draw; render it anew");
    const ValueScale scale = options.range.empty() ? scaleOfImage(image, options.logarithmic) : givenScale(options);
    return falseColourDrawing(image, {parseColourMap(options.map), scale}, title);
}

} // namespace

int falseColourCommand(const FalseColourOptions& options) {
    checkDrawingPath(options.output, "--output");
    const std::string title = fs::path(options.input).filename().string();
    writeDrawing(options.output,
                 fileEnding(options.input) == ".csv" ? drawingOfGrid(options, title) : drawingOfImage(options, title));
    if (!options.quiet) fmt::print("wrote {}\n", options.output);
    return 0;
}

} // namespace quasilux
