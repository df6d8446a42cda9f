// Trees behind others in one Bvh.
#pragma once

#include "prepare/bvh_block.h"

#include <functional>

namespace quasilux {

/// The box of an item.
using BoxOfItem = std::function<PrimitiveBounds(size_t index)>;
/// Makes what a leaf over these items is, and returns the reference to it.
using MakeLeaf = std::function<unsigned(const unsigned* indices, unsigned count)>;

/// Appends a tree over `count` > 0 items with leaves of at most `perLeaf` <= 8 of them. Returns its root, a node.
unsigned appendTree(size_t count, const BoxOfItem& itemBox, unsigned perLeaf, const MakeLeaf& makeLeaf, Bvh& bvh);
/// The same over primitives, with a block for each leaf; primitive i becomes index `firstPrimitive` + i in the lanes.
unsigned appendTree(const std::vector<BvhPrimitive>& primitives, unsigned firstPrimitive, Bvh& bvh);
/// Makes node 0, which is there already, the parent of these nodes, at most eight.
void joinTrees(const std::vector<unsigned>& roots, Bvh& bvh);

} // namespace quasilux
