// Where photons matter: cells of kernels/importance.clh from the vertices of pilot paths.
#pragma once

#include "device/program.h"
#include "prepare/device_scene.h"

#include <vector>

namespace quasilux {

/// For so many pilot paths; no cells yet.
shared::ImportanceGrid importanceGrid(const DeviceScene& scene, unsigned paths);

/// The table of the grid, as the kernels read it, which gets as many cells as it takes. `pathWeights`: 1 / brightness of each
/// path's pixel, over the number of paths. `keys` and `sizes` of all vertices come from the kernel findImportanceCells.
std::vector<uint32_t> importanceCells(const std::vector<shared::PilotPath>& paths,
                                      const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                      const std::vector<float>& sizes, shared::ImportanceGrid& grid);

} // namespace quasilux
