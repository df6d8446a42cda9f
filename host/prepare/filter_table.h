// Reconstruction filters wider than a pixel, as a table (kernels/filter_table.clh).
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

/// Any but the box of a pixel, of cameras.
bool needsFilterTable(const Sensor& sensor);

/// Whether less noise is left where pixels share samples, f^2 of them, than where each has its own, drawn in proportion
/// to |f|: wide filters f (integral 1 along an axis) with integral f^2 < (integral |f|)^2. In a narrow one a pixel
/// would have samples in few passes, and then with large weights.
bool gainsBySharing(const Sensor& sensor);

/// Cells on either side of the pixel's centre.
unsigned filterReach(const Sensor& sensor);

/// Steps of 2 · filterReach cells and their end; empty where no table is needed.
std::vector<shared::FilterStep> filterTable(const Sensor& sensor);

} // namespace quasilux
