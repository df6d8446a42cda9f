// A grid of measured points, as `quasilux render --grid` writes it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quasilux {

struct GridValues {
    unsigned nx = 0, ny = 0;
    double lengthU = 0, lengthV = 0;   ///< of its sides, in scene units
    std::vector<double> values;        ///< row by row, as the table has them
    std::vector<double> standardError; ///< empty: unknown
    std::string unit = "lx";
    bool isPerNanometre = false; ///< made of W per nanometre, so that it is some 107 times too low

    double spacingU() const { return lengthU / nx; }
    double spacingV() const { return lengthV / ny; }
};

/// Which column of the table is read.
enum class GridQuantity { illuminance, daylightFactor };

/// `grid`: which one of a table of several; empty: it has one. Throws InputError at file:line.
GridValues readGridTable(const std::string& path, GridQuantity quantity, const std::string& grid = {});

} // namespace quasilux
