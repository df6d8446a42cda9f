// Where photons matter: cells of kernels/importance.clh from the vertices of importance paths.
#pragma once

#include "learn/aims.h"
#include "prepare/device_scene.h"

#include <vector>

namespace quasilux {

/// For so many importance paths; no cells yet.
shared::ImportanceGrid importanceGrid(const DeviceScene& scene, unsigned paths);

/// The table of the grid, as the kernels read it, which gets as many cells as it takes. `pathWeights`: 1 / brightness
/// of each path's pixel, over the number of paths. `keys`, fine and coarse, and `sizes` of all vertices come from the
/// kernel findImportanceCells. Scattered light is aimed at those of `aims` that much of it should come through.
std::vector<uint32_t> importanceCells(const std::vector<shared::ImportancePath>& paths,
                                      const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                      const std::vector<float>& sizes, const std::vector<AimSet>& aims,
                                      shared::ImportanceGrid& grid);

/// By vertex of the paths, IMPORTANCE_VERTICES of each: is most of what is scattered there wasted? A photon that is
/// scattered there brings less than a tenth of the mean over all vertices. `keys` and `sizes` as above.
std::vector<bool> wastedScattering(const std::vector<shared::ImportancePath>& paths,
                                   const std::vector<double>& pathWeights, const std::vector<uint32_t>& keys,
                                   const std::vector<float>& sizes);

/// Bits of the cells where importance paths gathered, by their keys (0: none), as LearnedTables has them.
std::vector<uint32_t> seenCells(std::vector<uint32_t> keys);

} // namespace quasilux
