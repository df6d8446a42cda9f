// Camera paths by pixel: more where those of a pixel have more noise (docs/method/camera-paths.md).
#pragma once

#include <cstdint>
#include <vector>

namespace quasilux {

/// Of the light that camera paths find themselves, without that of photons.
struct PathNoise {
    unsigned columns = 0, rows = 0; ///< blocks of the image
    std::vector<double> variance;   ///< of a path, as a share of relMSE, by block
    std::vector<double> cost;       ///< of a path, by block, in any unit above 0
};

/// Paths in a pass of each pixel of a block, powers of two: together they cost no more than `paths` of each pixel do,
/// but where each has one already. The variance that is left at this cost is least where paths go as the root of
/// variance over cost (Neyman 1934; Cochran 1977, eq. 5.21).
std::vector<uint32_t> allocatePaths(const PathNoise& noise, unsigned paths);

/// Variance of the image with `paths` of each pixel over that with `counts` of each block. `noise` must know nothing of
/// what the counts were chosen by: a rare path that was met there would be counted as removed.
double varianceSaved(const PathNoise& noise, const std::vector<uint32_t>& counts, unsigned paths);

/// What `counts` cost, as a share of `paths` of each pixel.
double costShare(const PathNoise& noise, const std::vector<uint32_t>& counts, unsigned paths);

PathNoise meanOf(const PathNoise& a, const PathNoise& b);

} // namespace quasilux
