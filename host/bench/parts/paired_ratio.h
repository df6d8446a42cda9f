// The ratio of two costs that were measured by turns.
#pragma once

#include <vector>

namespace quasilux {

/// Median of the pairs' ratios: a pair that something disturbed does not count for more than another.
struct PairedRatio {
    double ratio = 0;
    double standardError = 0; ///< of it, from the quartiles of the pairs; 0 of a single pair
};

/// Ratios above 0, at least one.
PairedRatio medianRatio(std::vector<double> ratios);

} // namespace quasilux
