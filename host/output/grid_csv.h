// The points of an illuminance-grid as a table.
#pragma once

#include "output/render_record.h"

namespace quasilux {

/// One line a point, row by row; before them comment lines (#) with the settings, as in the header of the images, and one
/// line of column names (docs/reference/command-line.md). `image` is of the grid's size. The file appears whole or not at all.
/// Throws std::runtime_error.
void writeGridCsv(const std::string& path, const IlluminanceGrid& grid, const FilmImage& image,
                  const RenderRecord& record);

} // namespace quasilux
