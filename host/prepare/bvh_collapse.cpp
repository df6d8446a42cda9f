// What a wide node costs is its area alone: a ray that enters it tests all eight boxes at once.
#include "prepare/bvh_collapse.h"

#include <algorithm>
#include <limits>

namespace quasilux {
namespace {

constexpr unsigned mostSlots = BVH_WIDTH - 1; // that one of two children may take

/// Of the slots of a child.
float costOf(const BuildItem& item, unsigned slots) {
    return item.isLeaf ? 0 : static_cast<const BuildNode&>(item).cost[slots - 1];
}

struct Share {
    float cost;
    unsigned left; ///< slots that the left child takes
};

/// How `slots` >= 2 slots are best shared between the children.
Share bestShare(const BuildNode& node, unsigned slots) {
    Share best{std::numeric_limits<float>::infinity(), 1};
    for (unsigned left = std::max(1u, slots - std::min(slots - 1, mostSlots)); left <= std::min(slots - 1, mostSlots);
         ++left) {
        const float cost = costOf(*node.child[0], left) + costOf(*node.child[1], slots - left);
        if (cost < best.cost) best = {cost, left};
    }
    return best;
}

void gather(const BuildNode& node, unsigned slots, WideNode& wide) {
    const unsigned left = bestShare(node, slots).left;
    for (unsigned side = 0; side < 2; ++side) {
        const BuildItem& item = *node.child[side];
        unsigned share = side == 0 ? left : slots - left;
        while (share > 1 && costOf(item, share) == costOf(item, share - 1)) --share;
        if (share > 1)
            gather(static_cast<const BuildNode&>(item), share, wide);
        else
            wide.slot[wide.count++] = {&item, &node.bounds[side]};
    }
}

} // namespace

float halfArea(const RTCBounds& bounds) {
    const float x = bounds.upper_x - bounds.lower_x, y = bounds.upper_y - bounds.lower_y,
                z = bounds.upper_z - bounds.lower_z;
    return x * y + y * z + z * x;
}

float leastWideCost(float rootArea) { return rootArea > 0 ? 1e-6f * rootArea : 1; }

void weighSlots(BuildNode& node, float area, float least) {
    for (unsigned side = 0; side < 2; ++side)
        if (!node.child[side]->isLeaf)
            weighSlots(static_cast<BuildNode&>(*node.child[side]), halfArea(node.bounds[side]), least);
    node.cost[0] = std::max(area, least) + bestShare(node, BVH_WIDTH).cost;
    for (unsigned slots = 2; slots <= mostSlots; ++slots)
        node.cost[slots - 1] = std::min(bestShare(node, slots).cost, node.cost[slots - 2]);
}

WideNode wideNode(const BuildNode& node) {
    WideNode wide;
    gather(node, BVH_WIDTH, wide);
    return wide;
}

size_t countWideNodes(const BuildNode& node) {
    const WideNode wide = wideNode(node);
    size_t count = 1;
    for (unsigned slot = 0; slot < wide.count; ++slot)
        if (!wide.slot[slot].item->isLeaf)
            count += countWideNodes(static_cast<const BuildNode&>(*wide.slot[slot].item));
    return count;
}

} // namespace quasilux
