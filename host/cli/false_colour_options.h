// Options of `quasilux falsecolour`.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

struct FalseColourOptions {
    std::string input, output;
    std::string range; ///< "A:B"; empty: automatic
    bool logarithmic = false;
    std::string map = "viridis";
    std::vector<double> levels; ///< of grids; empty: the scale's marks
    bool photometric = false, daylightFactor = false;
    std::optional<double> efficacy; ///< lm/W of an image
    std::string grid;               ///< of a table of several; empty: it has one
    bool quiet = false;
};

void declareFalseColour(CLI::App& app, FalseColourOptions& options);

} // namespace quasilux
