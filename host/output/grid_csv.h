// The points of illuminance-grids as a table.
#pragma once

#include "output/render_record.h"

namespace quasilux {

/// The points of the record's grids, one line each, row by row; before them comment lines (#) with the settings, as in
/// the header of the images, and one line of column names (docs/reference/command-line.md). The file appears whole or
/// not at all. Throws std::runtime_error.
void writeGridCsv(const std::string& path, const FilmImage& image, const RenderRecord& record);

} // namespace quasilux
