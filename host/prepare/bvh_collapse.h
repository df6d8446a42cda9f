// The binary tree of the builder, and which of its nodes become nodes of eight (docs/method/traversal.md).
#pragma once

#include "shared_types.h"

#include <array>
#include <cstddef>
#include <embree3/rtcore.h>

namespace quasilux {

/// What Embree's builder makes; lives in Embree's own arena.
struct BuildItem {
    bool isLeaf;
};
struct BuildLeaf : BuildItem {
    unsigned count;
    unsigned primitive[BVH_WIDTH];
};
struct BuildNode : BuildItem {
    std::array<BuildItem*, 2> child;
    std::array<RTCBounds, 2> bounds;
    /// cost[i - 1]: the least cost of the wide nodes below this one if i slots of a wide node hold what is below it.
    std::array<float, BVH_WIDTH - 1> cost;
};

/// What one slot of a wide node holds.
struct WideSlot {
    const BuildItem* item;
    const RTCBounds* bounds;
};
struct WideNode {
    std::array<WideSlot, BVH_WIDTH> slot;
    unsigned count = 0;
};

/// Fills in `cost` of `node`, whose box has half the area `area`, and of all nodes below it. A wide node costs its
/// area, but no less than `least`, so that where boxes are flat as lines few nodes are better than many. Dynamic
/// programming over the binary tree: Ylitie, Karras & Laine, "Efficient Incoherent Ray Traversal on GPUs Through
/// Compressed Wide BVHs", HPG 2017, section 3.1; leaves are given, so their share of the cost is constant and left out.
void weighSlots(BuildNode& node, float area, float least);

/// A millionth of the root's area: next to nothing beside it, and something where it is 0.
float leastWideCost(float rootArea);

/// Half the area of a box.
float halfArea(const RTCBounds& bounds);

/// The children of the wide node that `node`, weighed, becomes, from left to right.
WideNode wideNode(const BuildNode& node);

/// Of the whole tree below `node`, weighed; itself included.
size_t countWideNodes(const BuildNode& node);

} // namespace quasilux
