// Lines of equal value by marching squares (Lorensen & Cline 1987 in two dimensions).
#pragma once

#include "drawing/drawing.h"

#include <vector>

namespace quasilux {

/// Values at the crossings of lines x[i] and y[j], which rise; linear along the edges between.
struct Field {
    std::vector<double> x, y, values; ///< row by row: values[j * x.size() + i]

    double at(size_t i, size_t j) const { return values[j * x.size() + i]; }
    /// Bilinear; beyond the ends the value there.
    double value(double atX, double atY) const;
};

/// Where the field has the value `level`: lines that are closed or end at the border. A place that has it exactly
/// counts as above. Where a cell has two lines, the mean of its corners says which way they go.
std::vector<std::vector<Place>> contoursOf(const Field& field, double level);

double lengthOf(const std::vector<Place>& line);
/// Half its length from the beginning.
Place middleOf(const std::vector<Place>& line);

} // namespace quasilux
