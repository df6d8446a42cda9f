// Runs Embree's binned-SAH builder with eight-wide leaves, and flattens its binary tree into nodes of eight
// (docs/method/traversal.md).
#include "prepare/bvh.h"

#include "prepare/bvh_append.h"
#include "prepare/bvh_collapse.h"

#include <algorithm>
#include <atomic>
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <limits>
#include <memory>
#include <new>

namespace quasilux {
namespace {

constexpr size_t maximumPrimitives = size_t(PRIMITIVE_INDEX_MASK); // the mask itself is left to QL_NONE
// Of the binary tree. Eight levels before it the builder halves by count, and it fails where that does not suffice.
// Where all ways to split cost the same it takes a bin of 32 a level, so 2^29 primitives on a line need 570 levels.
constexpr unsigned maximumDepth = 1024;
constexpr size_t maximumBlocks = size_t(BVH_LEAF_FIRST_MASK) + 1;

template <typename Item>
Item* allocateItem(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Item), 16)) Item;
}

void* createNode(RTCThreadLocalAllocator allocator, unsigned, void*) {
    auto* node = allocateItem<BuildNode>(allocator);
    node->isLeaf = false;
    return node;
}

void setChildren(void* node, void** children, unsigned, void*) {
    for (unsigned side = 0; side < 2; ++side)
        static_cast<BuildNode*>(node)->child[side] = static_cast<BuildItem*>(children[side]);
}

void setBounds(void* node, const RTCBounds** bounds, unsigned, void*) {
    for (unsigned side = 0; side < 2; ++side) static_cast<BuildNode*>(node)->bounds[side] = *bounds[side];
}

void* createLeaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, size_t count, void* leaves) {
    auto* item = allocateItem<BuildLeaf>(allocator);
    ++*static_cast<std::atomic<size_t>*>(leaves);
    item->isLeaf = true;
    item->count = unsigned(count);
    for (size_t i = 0; i < count; ++i) item->primitive[i] = primitives[i].primID;
    // The builder's threads leave the order open; lanes in order of index make the tree the same every time.
    std::sort(item->primitive, item->primitive + count);
    return item;
}

RTCBuildArguments buildArguments(RTCBVH bvh, unsigned perLeaf, std::vector<RTCBuildPrimitive>& primitives,
                                 std::atomic<size_t>& leaves) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = maximumDepth;
    // Minimum = maximum = block size: with smaller leaves allowed, half of the lanes stay empty.
    arguments.sahBlockSize = arguments.minLeafSize = arguments.maxLeafSize = perLeaf;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = createNode;
    arguments.setNodeChildren = setChildren;
    arguments.setNodeBounds = setBounds;
    arguments.createLeaf = createLeaf;
    arguments.userPtr = &leaves;
    return arguments;
}

shared::BvhNode emptyNode() {
    shared::BvhNode node;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (float* lower : {node.lowerX, node.lowerY, node.lowerZ}) std::fill_n(lower, BVH_WIDTH, infinity);
    for (float* upper : {node.upperX, node.upperY, node.upperZ}) std::fill_n(upper, BVH_WIDTH, -infinity);
    // No ray enters an empty slot, except one that is not a number: it then finds a block and no hit, not a way back to
    // the root.
    std::fill_n(node.child, BVH_WIDTH, BVH_LEAF_BIT);
    return node;
}

void setSlot(shared::BvhNode& node, unsigned slot, const RTCBounds& bounds) {
    node.lowerX[slot] = bounds.lower_x;
    node.lowerY[slot] = bounds.lower_y;
    node.lowerZ[slot] = bounds.lower_z;
    node.upperX[slot] = bounds.upper_x;
    node.upperY[slot] = bounds.upper_y;
    node.upperZ[slot] = bounds.upper_z;
}

/// Turns the builder's tree into nodes, depth first.
class Flattener {
public:
    Flattener(const MakeLeaf& makeLeaf, Bvh& bvh) : makeLeaf_(makeLeaf), bvh_(bvh) {}

    /// Appends `item` and what lies below it; returns the reference that a parent's slot holds.
    unsigned append(const BuildItem& item, unsigned depth) {
        if (item.isLeaf) {
            const auto& leaf = static_cast<const BuildLeaf&>(item);
            return makeLeaf_(leaf.primitive, leaf.count);
        }
        const WideNode node = wideNode(static_cast<const BuildNode&>(item));
        const unsigned index = unsigned(bvh_.nodes.size());
        bvh_.depth = std::max(bvh_.depth, depth);
        bvh_.nodes.push_back(emptyNode());
        for (unsigned slot = 0; slot < node.count; ++slot) {
            setSlot(bvh_.nodes[index], slot, *node.slot[slot].bounds);
            const unsigned reference = append(*node.slot[slot].item, depth + 1);
            bvh_.nodes[index].child[slot] = reference;
        }
        return index;
    }

private:
    const MakeLeaf& makeLeaf_;
    Bvh& bvh_;
};

struct EmbreeRelease {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

/// In the builder's form; its array has room to spare, as the builder asks for.
std::vector<RTCBuildPrimitive> buildPrimitives(size_t count, const BoxOfItem& itemBox) {
    std::vector<RTCBuildPrimitive> result(count);
    for (size_t i = 0; i < count; ++i) {
        const PrimitiveBounds box = itemBox(i);
        result[i] = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, unsigned(i)};
    }
    return result;
}

RTCBounds unionOf(const std::vector<RTCBuildPrimitive>& primitives) {
    RTCBounds all{};
    all.lower_x = all.lower_y = all.lower_z = std::numeric_limits<float>::infinity();
    all.upper_x = all.upper_y = all.upper_z = -std::numeric_limits<float>::infinity();
    for (const RTCBuildPrimitive& primitive : primitives) {
        all.lower_x = std::min(all.lower_x, primitive.lower_x);
        all.lower_y = std::min(all.lower_y, primitive.lower_y);
        all.lower_z = std::min(all.lower_z, primitive.lower_z);
        all.upper_x = std::max(all.upper_x, primitive.upper_x);
        all.upper_y = std::max(all.upper_y, primitive.upper_y);
        all.upper_z = std::max(all.upper_z, primitive.upper_z);
    }
    return all;
}

unsigned appendEmptyNode(Bvh& bvh) {
    bvh.nodes.push_back(emptyNode());
    return unsigned(bvh.nodes.size() - 1);
}

unsigned appendBlock(const std::vector<BvhPrimitive>& primitives, unsigned firstPrimitive, const unsigned* indices,
                     unsigned count, Bvh& bvh) {
    const size_t block = bvh.blocks.size();
    if (block >= maximumBlocks)
        throw InputError(fmt::format("the scene has too many primitives ({}): the tree holds at most {} blocks of up "
                                     "to {}; simplify the meshes or split the scene",
                                     primitives.size(), maximumBlocks, BVH_WIDTH));
    bvh.blocks.push_back(makeBlock(primitives, indices, count));
    for (unsigned lane = 0; lane < count; ++lane) bvh.blocks.back().primitive[lane] += firstPrimitive;
    return BVH_LEAF_BIT | unsigned(block); // one block: (blocks - 1) << BVH_LEAF_COUNT_SHIFT is 0
}

} // namespace

void joinTrees(const std::vector<unsigned>& roots, Bvh& bvh) {
    shared::BvhNode joint = emptyNode();
    for (unsigned slot = 0; slot < roots.size(); ++slot) {
        const shared::BvhNode& node = bvh.nodes[roots[slot]];
        joint.lowerX[slot] = *std::min_element(node.lowerX, node.lowerX + BVH_WIDTH);
        joint.lowerY[slot] = *std::min_element(node.lowerY, node.lowerY + BVH_WIDTH);
        joint.lowerZ[slot] = *std::min_element(node.lowerZ, node.lowerZ + BVH_WIDTH);
        joint.upperX[slot] = *std::max_element(node.upperX, node.upperX + BVH_WIDTH);
        joint.upperY[slot] = *std::max_element(node.upperY, node.upperY + BVH_WIDTH);
        joint.upperZ[slot] = *std::max_element(node.upperZ, node.upperZ + BVH_WIDTH);
        joint.child[slot] = roots[slot];
    }
    bvh.nodes[0] = joint;
}

unsigned appendTree(size_t count, const BoxOfItem& itemBox, unsigned perLeaf, const MakeLeaf& makeLeaf, Bvh& bvh) {
    std::vector<RTCBuildPrimitive> bounded = buildPrimitives(count, itemBox);
    const RTCBounds all = unionOf(bounded);

    const std::unique_ptr<RTCDeviceTy, EmbreeRelease> device(rtcNewDevice(nullptr));
    if (!device)
        throw std::runtime_error(fmt::format("Embree did not start (error {})", int(rtcGetDeviceError(nullptr))));
    const std::unique_ptr<RTCBVHTy, EmbreeRelease> arena(rtcNewBVH(device.get()));
    std::atomic<size_t> leaves = 0; // counted as the builder's threads go, so that blocks are allocated once
    const RTCBuildArguments arguments = buildArguments(arena.get(), perLeaf, bounded, leaves);
    auto* root = static_cast<BuildItem*>(rtcBuildBVH(&arguments));
    if (!root)
        throw std::runtime_error(fmt::format("Embree could not build the tree over {} primitives (error {})", count,
                                             int(rtcGetDeviceError(device.get()))));

    if (perLeaf > 1) bvh.blocks.reserve(bvh.blocks.size() + leaves);
    Flattener flattener(makeLeaf, bvh);
    if (root->isLeaf) {
        const unsigned index = appendEmptyNode(bvh);
        setSlot(bvh.nodes[index], 0, all);
        const unsigned reference = flattener.append(*root, 1);
        bvh.nodes[index].child[0] = reference;
        return index;
    }
    auto& node = static_cast<BuildNode&>(*root);
    const float area = halfArea(all);
    weighSlots(node, area, leastWideCost(area));
    bvh.nodes.reserve(bvh.nodes.size() + countWideNodes(node));
    return flattener.append(*root, 1);
}

unsigned appendTree(const std::vector<BvhPrimitive>& primitives, unsigned firstPrimitive, Bvh& bvh) {
    if (primitives.size() > maximumPrimitives)
        throw InputError(
            fmt::format("the scene has {} primitives; at most {} fit. Simplify the meshes or split the scene",
                        primitives.size(), maximumPrimitives));
    if (primitives.empty()) {
        if (bvh.blocks.empty()) bvh.blocks.push_back(makeBlock(primitives, nullptr, 0)); // what the empty slots name
        return appendEmptyNode(bvh);
    }
    return appendTree(
        primitives.size(), [&](size_t i) { return boundsOf(primitives[i], i); }, BVH_WIDTH,
        [&](const unsigned* indices, unsigned count) {
            return appendBlock(primitives, firstPrimitive, indices, count, bvh);
        },
        bvh);
}

Bvh buildBvh(const std::vector<BvhPrimitive>& primitives) {
    Bvh bvh;
    appendTree(primitives, 0, bvh);
    return bvh;
}

std::string bvhOptions(const Bvh& bvh) {
    // Each inner node on the way leaves at most BVH_WIDTH - 1 children behind; one more while they are being sorted.
    const unsigned bound = (BVH_WIDTH - 1) * bvh.depth + 1;
    constexpr unsigned step = 32;
    return fmt::format("-DBVH_STACK_SIZE={}", (bound + step - 1) / step * step);
}

} // namespace quasilux
