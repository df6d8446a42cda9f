// Reconstruction filters wider than a pixel, as a table (kernels/filter_table.clh).
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Any but the box of a pixel, of cameras.
bool needsFilterTable(const Sensor& sensor);

/// Cells on either side of the pixel's centre.
unsigned filterReach(const Sensor& sensor);

/// Steps of 2 · filterReach cells and their end; empty where no table is needed.
std::vector<shared::FilterStep> filterTable(const Sensor& sensor);

} // namespace quasilux
