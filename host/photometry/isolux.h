// Lines of equal illuminance over a grid of points.
#pragma once

#include "photometry/false_colour.h"
#include "photometry/grid_values.h"

namespace quasilux {

/// From a round value below the least to one above the greatest.
ValueScale scaleOfGrid(const GridValues& grid, bool logarithmic);

/// The grid from above where edge-u × edge-v looks up, edge-u to the right: false colours, lines at `levels` (of the
/// scale's marks, if there are none) with their values, and the values of the points where there is room. Values are
/// bilinear between the points, and from the outermost points to the border as at these. A grid that is no rectangle is
/// drawn as one.
Drawing isoluxDrawing(const GridValues& grid, const FalseColours& colours, std::vector<double> levels,
                      const std::string& title);

} // namespace quasilux
