// How far two images are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace quasilux {

/// Of a value, relative to that of `b`; infinite where sizes differ.
inline double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
    if (a.size() != b.size()) return INFINITY;
    double largest = 0;
    for (size_t k = 0; k < a.size(); ++k)
        largest = std::max(largest, std::abs(double(a[k]) - b[k]) / std::max(1e-30, std::abs(double(b[k]))));
    return largest;
}

} // namespace quasilux
