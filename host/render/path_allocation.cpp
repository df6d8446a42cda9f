#include "render/path_allocation.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

// A few paths do not know a variance that comes from rare ones: as much of the mean root is added everywhere.
constexpr double unseenShare = 0.1;
// Paths of a pixel in a pass, times those asked for: no work-item is to hold up all others for long.
constexpr double mostTimesMean = 64;

// Mean over a block and its neighbours, as far as they are in the image.
double meanAbout(const PathNoise& noise, const std::vector<double>& values, unsigned column, unsigned row) {
    double sum = 0, count = 0;
    for (unsigned v = row > 0 ? row - 1 : 0; v <= row + 1 && v < noise.rows; ++v)
        for (unsigned u = column > 0 ? column - 1 : 0; u <= column + 1 && u < noise.columns; ++u) {
            sum += values[size_t(v) * noise.columns + u];
            count += 1;
        }
    return sum / count;
}

std::vector<double> smoothed(const PathNoise& noise, const std::vector<double>& values) {
    std::vector<double> means;
    means.reserve(values.size());
    for (unsigned row = 0; row < noise.rows; ++row)
        for (unsigned column = 0; column < noise.columns; ++column)
            means.push_back(meanAbout(noise, values, column, row));
    return means;
}

// As the root of variance over cost, relative to a mean that is weighted by cost.
std::vector<double> sharesOf(const PathNoise& noise) {
    const std::vector<double> variance = smoothed(noise, noise.variance), cost = smoothed(noise, noise.cost);
    std::vector<double> shares;
    shares.reserve(variance.size());
    double ofShares = 0, all = 0;
    for (size_t k = 0; k < variance.size(); ++k) {
        shares.push_back(std::sqrt(std::max(0.0, variance[k]) / cost[k]));
        ofShares += shares[k] * cost[k];
        all += cost[k];
    }
    const double usual = ofShares / all;
    for (double& share : shares) share = usual > 0 ? (share / usual + unseenShare) / (1 + unseenShare) : 1;
    return shares;
}

uint32_t nearestPower(double paths) {
    return uint32_t{1} << static_cast<unsigned>(std::lround(std::log2(std::max(paths, 1.0))));
}

std::vector<uint32_t> countsOf(const std::vector<double>& shares, double paths, double most) {
    std::vector<uint32_t> counts;
    counts.reserve(shares.size());
    for (const double share : shares) counts.push_back(nearestPower(std::min(paths * share, most)));
    return counts;
}

double costOf(const PathNoise& noise, const std::vector<uint32_t>& counts) {
    double cost = 0;
    for (size_t k = 0; k < counts.size(); ++k) cost += counts[k] * noise.cost[k];
    return cost;
}

} // namespace

std::vector<uint32_t> allocatePaths(const PathNoise& noise, unsigned paths) {
    const std::vector<double> shares = sharesOf(noise);
    const double mostPaths = mostTimesMean * paths,
                 mostCost = costOf(noise, std::vector<uint32_t>(shares.size(), paths));
    double low = 0, high = mostPaths; // of their mean: rounding and the largest shares move the cost
    for (int step = 0; step < 20; ++step) {
        const double middle = (low + high) / 2;
        (costOf(noise, countsOf(shares, middle, mostPaths)) > mostCost ? high : low) = middle;
    }
    return countsOf(shares, low, mostPaths);
}

double costShare(const PathNoise& noise, const std::vector<uint32_t>& counts, unsigned paths) {
    return costOf(noise, counts) / costOf(noise, std::vector<uint32_t>(counts.size(), paths));
}

double varianceSaved(const PathNoise& noise, const std::vector<uint32_t>& counts, unsigned paths) {
    double even = 0, byBlock = 0;
    for (size_t k = 0; k < counts.size(); ++k) {
        even += noise.variance[k] / paths;
        byBlock += noise.variance[k] / counts[k];
    }
    return byBlock > 0 ? even / byBlock : 1;
}

PathNoise meanOf(const PathNoise& a, const PathNoise& b) {
    PathNoise mean = a;
    for (size_t k = 0; k < mean.variance.size(); ++k) mean.variance[k] = (a.variance[k] + b.variance[k]) / 2;
    return mean;
}

} // namespace quasilux
