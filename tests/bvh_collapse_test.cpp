// Wide nodes of random binary trees against all ways to choose them. Seeds are fixed and nothing is estimated.
#include "prepare/bvh_collapse.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <list>
#include <random>
#include <vector>

namespace quasilux {
namespace {

/// A box of this half area: a square without height.
RTCBounds boxOf(float area) {
    RTCBounds bounds{};
    bounds.upper_x = bounds.upper_y = std::sqrt(area);
    return bounds;
}

class RandomTree {
public:
    RandomTree(unsigned seed, unsigned leaves) : random_(seed) { root_ = static_cast<BuildNode*>(make(leaves)); }

    BuildNode& root() { return *root_; }
    void flatten() {
        for (BuildNode& node : nodes_) node.bounds = {boxOf(0), boxOf(0)};
    }
    const std::list<BuildLeaf>& leaves() const { return leaves_; } ///< from left to right

private:
    BuildItem* make(unsigned leaves) {
        if (leaves == 1) {
            leaves_.push_back({{true}, 1, {}});
            return &leaves_.back();
        }
        nodes_.push_back({});
        BuildNode& node = nodes_.back();
        node.isLeaf = false;
        const unsigned left = std::uniform_int_distribution(1u, leaves - 1)(random_);
        node.child = {make(left), make(leaves - left)};
        for (auto& bounds : node.bounds) bounds = boxOf(std::uniform_real_distribution<float>(0.1f, 1)(random_));
        return &node;
    }

    std::mt19937 random_;
    std::list<BuildNode> nodes_;
    std::list<BuildLeaf> leaves_;
    BuildNode* root_ = nullptr;
};

/// Slots that a part of a wide node takes, and the area of the wide nodes below it.
struct Choice {
    unsigned slots;
    double area;
};

double leastArea(const BuildNode& node, double area);

/// All ways to fill slots with what is below an item: itself, or what is below its children.
std::vector<Choice> choices(const BuildItem& item, double area) {
    if (item.isLeaf) return {{1, 0}};
    const auto& node = static_cast<const BuildNode&>(item);
    std::vector<Choice> all{{1, leastArea(node, area)}};
    for (const Choice& left : choices(*node.child[0], halfArea(node.bounds[0])))
        for (const Choice& right : choices(*node.child[1], halfArea(node.bounds[1])))
            all.push_back({left.slots + right.slots, left.area + right.area});
    return all;
}

double leastArea(const BuildNode& node, double area) {
    double least = std::numeric_limits<double>::infinity();
    for (const Choice& left : choices(*node.child[0], halfArea(node.bounds[0])))
        for (const Choice& right : choices(*node.child[1], halfArea(node.bounds[1])))
            if (left.slots + right.slots <= BVH_WIDTH) least = std::min(least, left.area + right.area);
    return area + least;
}

/// What the builder itself would do: open the largest of the slots until all are taken.
WideNode greedyNode(const BuildNode& node) {
    WideNode wide;
    for (unsigned side = 0; side < 2; ++side) wide.slot[wide.count++] = {node.child[side], &node.bounds[side]};
    while (wide.count < BVH_WIDTH) {
        WideSlot* largest = nullptr;
        for (unsigned i = 0; i < wide.count; ++i)
            if (!wide.slot[i].item->isLeaf && (!largest || halfArea(*wide.slot[i].bounds) > halfArea(*largest->bounds)))
                largest = &wide.slot[i];
        if (!largest) break;
        const auto& opened = static_cast<const BuildNode&>(*largest->item);
        *largest = {opened.child[0], &opened.bounds[0]};
        wide.slot[wide.count++] = {opened.child[1], &opened.bounds[1]};
    }
    return wide;
}

/// Area of the wide nodes from `node` on, and its leaves in their order.
template <typename Widen>
double walk(const BuildNode& node, double area, const Widen& widen, std::vector<const BuildItem*>& leaves) {
    const WideNode wide = widen(node);
    EXPECT_LE(wide.count, unsigned{BVH_WIDTH});
    for (unsigned slot = 0; slot < wide.count; ++slot) {
        const auto [item, bounds] = wide.slot[slot];
        if (item->isLeaf)
            leaves.push_back(item);
        else
            area += walk(static_cast<const BuildNode&>(*item), halfArea(*bounds), widen, leaves);
    }
    return area;
}

TEST(BvhCollapse, HasTheLeastAreaOfAllWays) {
    double chosen = 0, greedy = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        RandomTree tree(seed, 9 + seed % 7);
        weighSlots(tree.root(), 1, 0);
        std::vector<const BuildItem*> leaves, others;
        const double area = walk(tree.root(), 1, wideNode, leaves);
        EXPECT_NEAR(area, leastArea(tree.root(), 1), 1e-5) << "seed " << seed;
        EXPECT_NEAR(tree.root().cost[0], area, 1e-5);
        std::vector<const BuildItem*> all;
        for (const auto& leaf : tree.leaves()) all.push_back(&leaf);
        EXPECT_EQ(leaves, all) << "each leaf once, from left to right";
        chosen += area;
        greedy += walk(tree.root(), 1, greedyNode, others);
    }
    EXPECT_GT(greedy, 1.02 * chosen) << "the control must be seen to be worse";
}

// Boxes without area: all ways are alike but for the number of nodes. Control: at no cost a node they stay binary.
TEST(BvhCollapse, TakesFewNodesWhereAreasDoNotTell) {
    RandomTree tree(3, 200);
    tree.flatten();
    weighSlots(tree.root(), 0, leastWideCost(0));
    const size_t few = countWideNodes(tree.root());
    EXPECT_LE(few, 60u);
    weighSlots(tree.root(), 0, 0);
    EXPECT_GT(countWideNodes(tree.root()), 2 * few);
}

TEST(BvhCollapse, CountsWhatItMakes) {
    RandomTree tree(7, 200);
    weighSlots(tree.root(), 1, 0);
    size_t count = 0;
    const auto counted = [&](const BuildNode& node) {
        ++count;
        return wideNode(node);
    };
    std::vector<const BuildItem*> leaves;
    walk(tree.root(), 1, counted, leaves);
    EXPECT_EQ(countWideNodes(tree.root()), count);
    EXPECT_EQ(leaves.size(), 200u);
}

} // namespace
} // namespace quasilux
