#include "bench/parts/paired_ratio.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

/// Of sorted values, between neighbours in proportion.
double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(place);
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

} // namespace

PairedRatio medianRatio(std::vector<double> ratios) {
    std::sort(ratios.begin(), ratios.end());
    // Of a normal distribution the quartiles lie 1.349 standard deviations apart, and a median has 1.2533 times the
    // mean's error.
    const double deviation = (quantile(ratios, 0.75) - quantile(ratios, 0.25)) / 1.349;
    return {quantile(ratios, 0.5), 1.2533 * deviation / std::sqrt(static_cast<double>(ratios.size()))};
}

} // namespace quasilux
