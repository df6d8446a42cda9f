#include "learn/distance_octaves.h"

#include "prepare/pack.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace quasilux {

namespace {

constexpr double shareNearer = 0.01;

double distance(const shared::ImportancePath& path, const shared::Packed3& eye) {
    return glm::distance(unpack(path.vertices[0].position), unpack(eye));
}

double gathered(const shared::ImportancePath& path, double pathWeight) {
    const double weight = path.vertices[0].weight;
    return weight > 0 && std::isfinite(weight) ? weight * pathWeight : 0;
}

} // namespace

float nearestGathered(const std::vector<shared::ImportancePath>& paths, const std::vector<double>& pathWeights,
                      const shared::Packed3& eye) {
    std::vector<std::pair<double, double>> found; // distance, weight
    double all = 0, nearer = 0, nearest = 1;
    for (size_t k = 0; k < paths.size(); ++k) {
        const double weight = gathered(paths[k], pathWeights[k]);
        if (!(weight > 0)) continue;
        found.emplace_back(distance(paths[k], eye), weight);
        all += weight;
    }
    std::sort(found.begin(), found.end());
    for (const auto& [away, weight] : found) {
        nearest = away;
        nearer += weight;
        if (nearer >= shareNearer * all) break;
    }
    return std::max(static_cast<float>(nearest), std::numeric_limits<float>::min());
}

std::array<double, DISTANCE_OCTAVES> gatheredByOctave(const std::vector<shared::ImportancePath>& paths,
                                                      const std::vector<double>& pathWeights,
                                                      const shared::ImportanceGrid& grid) {
    std::array<double, DISTANCE_OCTAVES> sums{};
    for (size_t k = 0; k < paths.size(); ++k) {
        const double weight = gathered(paths[k], pathWeights[k]);
        if (!(weight > 0)) continue;
        const double octave = std::log2(std::max(distance(paths[k], grid.eye) / grid.nearest, 1.0));
        sums[static_cast<size_t>(std::min(octave, DISTANCE_OCTAVES - 1.0))] += weight;
    }
    return sums;
}

} // namespace quasilux
