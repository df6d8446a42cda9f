// Reconstruction filters that the kernels sample by a table (kernels/filter_table.clh).
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Whether the sensor's filter is not one of those that are sampled by formula, or ends at the edge of the image.
bool needsFilterTable(const Sensor& sensor);

/// Cells on either side of the pixel's centre.
unsigned filterReach(const Sensor& sensor);

/// Steps of 2 · filterReach cells and their end; empty where no table is needed.
std::vector<shared::FilterStep> filterTable(const Sensor& sensor);

} // namespace quasilux
