#include "learn/guide_tree.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace quasilux {

namespace {

constexpr size_t bins = 64;
// A cut must be significant: twice the log likelihood that it gains is chi-squared for samples without structure, and
// the best of all cuts is taken.
constexpr double leastEvidence = 16;

struct Cut {
    double gain = 0; // of the node's log likelihood, relative to its weight
    size_t dimension = 0;
    double at = 0.5; // share of the box
    double weightShare = 0.5;
};

struct Node {
    GuideBox box;
    size_t first = 0, last = 0; // of the samples, in their order then
    Cut cut;
    double priority = 0;

    bool operator<(const Node& other) const { return priority < other.priority; }
};

double divergence(double weight, double volume) { return weight > 0 ? weight * std::log(weight / volume) : 0; }

class TreeBuilder {
public:
    TreeBuilder(std::vector<GuideSample> samples, const GuideTreeSettings& settings)
        : samples_(std::move(samples)), settings_(settings) {}

    std::vector<GuideLeafBox> build(const GuideBox& root) {
        std::priority_queue<Node> open;
        std::vector<GuideLeafBox> leaves;
        open.push(evaluated({root, 0, samples_.size(), {}, 0}));
        while (!open.empty()) {
            const Node node = open.top();
            open.pop();
            if (!(node.priority > 0) || open.size() + leaves.size() + 2 > settings_.leaves) {
                leaves.push_back({node.box, squaresOf(node)});
                continue;
            }
            for (const Node& child : split(node)) open.push(evaluated(child));
        }
        return leaves;
    }

private:
    double squaresOf(const Node& node) const {
        double sum = 0;
        for (size_t k = node.first; k < node.last; ++k) sum += samples_[k].square;
        return sum;
    }

    Node evaluated(Node node) const {
        double sum = 0, squares = 0;
        std::array<std::array<double, bins>, emissionDimensions> weights{};
        for (size_t k = node.first; k < node.last; ++k) {
            const GuideSample& sample = samples_[k];
            const double w = sample.weight;
            sum += w;
            squares += w * w;
            for (size_t d = 0; d < emissionDimensions; ++d) {
                const double place = (double(sample.u[d]) - node.box.lower[d]) / node.box.size[d] * bins;
                weights[d][static_cast<size_t>(std::clamp(place, 0.0, bins - 1.0))] += w;
            }
        }
        if (!(sum > 0)) return node;
        for (size_t d = 0; d < emissionDimensions; ++d) tryDimension(node, d, weights[d], sum);
        const double effective = sum * sum / squares;
        if (2 * node.cut.gain * effective > leastEvidence) node.priority = node.cut.gain * node.box.probability;
        return node;
    }

    // By the weight of the samples in each of `bins` parts of the node.
    static void tryDimension(Node& node, size_t d, const std::array<double, bins>& weight, double sum) {
        double below = 0;
        for (size_t k = 1; k < bins; ++k) {
            below += weight[k - 1] / sum;
            const double at = double(k) / bins;
            const double gain = divergence(below, at) + divergence(1 - below, 1 - at);
            if (gain > node.cut.gain) node.cut = {gain, d, at, std::min(below, 1.0)};
        }
    }

    std::array<Node, 2> split(const Node& node) {
        const Cut& cut = node.cut;
        const double at = node.box.lower[cut.dimension] + cut.at * node.box.size[cut.dimension];
        const auto begin = samples_.begin();
        const auto middle = std::partition(begin + static_cast<std::ptrdiff_t>(node.first),
                                           begin + static_cast<std::ptrdiff_t>(node.last),
                                           [&](const GuideSample& sample) { return sample.u[cut.dimension] < at; });
        std::array<Node, 2> children;
        for (size_t side = 0; side < 2; ++side) {
            Node& child = children[side];
            child.box = node.box;
            const double volume = side == 0 ? cut.at : 1 - cut.at;
            const double weight = side == 0 ? cut.weightShare : 1 - cut.weightShare;
            if (side == 1) child.box.lower[cut.dimension] = at;
            child.box.size[cut.dimension] *= volume;
            child.box.probability *= (1 - settings_.smoothing) * weight + settings_.smoothing * volume;
        }
        children[0].first = node.first;
        children[0].last = children[1].first = static_cast<size_t>(middle - begin);
        children[1].last = node.last;
        return children;
    }

    std::vector<GuideSample> samples_;
    const GuideTreeSettings& settings_;
};

} // namespace

std::vector<GuideLeafBox> buildGuideTree(const std::vector<GuideSample>& samples, const GuideBox& root,
                                         const GuideTreeSettings& settings) {
    return TreeBuilder(samples, settings).build(root);
}

double guideGain(const std::vector<GuideLeafBox>& leaves, const GuideBox& root) {
    double second = 0;
    for (const auto& leaf : leaves) {
        const double share = leaf.box.probability / root.probability;
        second += share * share / (leaf.box.volume() / root.volume());
    }
    return second;
}

} // namespace quasilux
