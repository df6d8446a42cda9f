#include "prepare/volume_tables.h"

#include "volume_blocks.h"

#include <algorithm>

namespace quasilux {

namespace {

/// Index of a voxel in a row of n, wherever i points: wrapVoxel of kernels/volume_grid.clh.
size_t wrapped(int i, int n, unsigned wrap) {
    if (wrap == WRAP_CLAMP) return static_cast<size_t>(std::clamp(i, 0, n - 1));
    const int period = wrap == WRAP_MIRROR ? 2 * n : n;
    const int k = (i % period + period) % period;
    return static_cast<size_t>(k < n ? k : 2 * n - 1 - k);
}

/// Largest values over blocks of cells; cell i lies between the centres of the voxels i and i + 1 (or is voxel i), and
/// block b begins with cell VOLUME_BLOCK b - 1.
std::vector<float> blockMaxima(const VolumeDescription& volume) {
    const shared::VolumeGrid& grid = volume.device;
    int n[3], blocks[3];
    for (int axis = 0; axis < 3; ++axis) {
        n[axis] = static_cast<int>(grid.size[axis]);
        blocks[axis] = VOLUME_BLOCKS(n[axis]);
    }
    std::vector<float> maxima;
    maxima.reserve(size_t(blocks[0]) * size_t(blocks[1]) * size_t(blocks[2]));
    const auto maximumOf = [&](int bx, int by, int bz) {
        float largest = 0;
        for (int z = VOLUME_BLOCK * bz - 1; z < VOLUME_BLOCK * (bz + 1); ++z)
            for (int y = VOLUME_BLOCK * by - 1; y < VOLUME_BLOCK * (by + 1); ++y)
                for (int x = VOLUME_BLOCK * bx - 1; x < VOLUME_BLOCK * (bx + 1); ++x) {
                    const size_t row = wrapped(z, n[2], grid.wrap) * grid.size[1] + wrapped(y, n[1], grid.wrap);
                    largest = std::max(largest, volume.values[row * grid.size[0] + wrapped(x, n[0], grid.wrap)]);
                }
        return largest;
    };
    for (int z = 0; z < blocks[2]; ++z)
        for (int y = 0; y < blocks[1]; ++y)
            for (int x = 0; x < blocks[0]; ++x) maxima.push_back(maximumOf(x, y, z));
    return maxima;
}

} // namespace

void appendVolume(const VolumeDescription& volume, MediumTables& tables) {
    tables.grids.push_back(volume.device);
    tables.grids.back().firstValue = static_cast<unsigned>(tables.values.size());
    tables.values.insert(tables.values.end(), volume.values.begin(), volume.values.end());
    if (volume.device.channels != 1) return; // it is no extinction
    const std::vector<float> maxima = blockMaxima(volume);
    tables.values.insert(tables.values.end(), maxima.begin(), maxima.end());
}

} // namespace quasilux
