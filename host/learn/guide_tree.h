// A density over the cube of emission numbers from weighted samples of it: leaves of a k-d tree
// (docs/method/learning.md).
#pragma once

#include "prepare/guide_tables.h"

#include <array>
#include <cstddef>
#include <vector>

namespace quasilux {

struct GuideSample {
    std::array<float, emissionDimensions> u{};
    double weight = 0;
    /// Of a photon: its weight squared times the density that it was drawn from times the number of photons, so that
    /// these sum to the second moment of what photons bring to the image.
    double square = 0;
};

/// A leaf and the sum of its samples' squares.
struct GuideLeafBox {
    GuideBox box;
    double squares = 0;
};

struct GuideTreeSettings {
    size_t leaves = 2048; ///< at most
    /// Share of a box's probability that its halves get by volume, not by weight, at every cut: what no sample showed
    /// stays possible, and near what is known its weight stays moderate.
    double smoothing = 0.05;
};

/// Cuts `root` where the samples' density differs most. Leaves do not overlap and fill `root`; their probabilities are
/// above 0 and sum to its probability. Without samples it is `root` alone.
std::vector<GuideLeafBox> buildGuideTree(const std::vector<GuideSample>& samples, const GuideBox& root,
                                         const GuideTreeSettings& settings = {});

/// By how much the second moment of weights by `root` evenly exceeds that of weights by the samples' density, as the
/// leaves know it: 1 where nothing is gained.
double guideGain(const std::vector<GuideLeafBox>& leaves, const GuideBox& root);

} // namespace quasilux
