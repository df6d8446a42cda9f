#include "prepare/border_tree.h"

#include "prepare/pack.h"
#include "scene/box.h"

#include <algorithm>
#include <unordered_map>

namespace quasilux {
namespace {

/// Of the largest coordinate: what a kernel's distances in single precision may be off by.
constexpr double rounding = 1e-6;

/// A segment; `group`: the middle of all segments of its first patch, which keeps them together.
struct Entry {
    BorderSegment segment;
    glm::dvec3 middle, group;
};

using Entries = std::vector<Entry>::iterator;

Box boxOf(const BorderSegment& segment) {
    Box box;
    box.add(unpack(segment.a));
    box.add(unpack(segment.b));
    return box;
}

std::vector<Entry> entriesOf(const std::vector<BorderSegment>& segments) {
    std::unordered_map<unsigned, Box> boxes;
    for (const auto& segment : segments) boxes[segment.patchA].add(boxOf(segment));
    std::vector<Entry> entries;
    entries.reserve(segments.size());
    for (const auto& segment : segments)
        entries.push_back({segment, boxOf(segment).center(), boxes.at(segment.patchA).center()});
    return entries;
}

shared::BorderNode nodeOf(Entries first, Entries last) {
    Box box;
    shared::BorderNode node{};
    node.patchFirst = node.leaf = QL_NONE;
    for (auto entry = first; entry != last; ++entry) {
        box.add(boxOf(entry->segment));
        for (const unsigned patch : {entry->segment.patchA, entry->segment.patchB}) {
            if (patch == QL_NONE) continue;
            node.patchFirst = std::min(node.patchFirst, patch);
            node.patchLast = std::max(node.patchLast, patch);
        }
    }
    const glm::dvec3 largest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    node.center = pack(box.center());
    const double slack = rounding * std::max({largest.x, largest.y, largest.z});
    node.halfExtent = pack(0.5 * box.extent() + slack);
    node.radius = static_cast<float>(0.5 * box.diagonal() * (1 + rounding) + slack);
    return node;
}

/// Of at most BORDER_LANES segments.
shared::BorderLeaf leafOf(Entries first, Entries last) {
    shared::BorderLeaf leaf{};
    for (size_t lane = 0; lane < BORDER_LANES; ++lane) {
        const bool isThere = lane < static_cast<size_t>(last - first);
        const BorderSegment& segment = first[isThere ? static_cast<ptrdiff_t>(lane) : 0].segment;
        const shared::Packed3 a = segment.a, b = isThere ? segment.b : a;
        leaf.ax[lane] = a.x, leaf.ay[lane] = a.y, leaf.az[lane] = a.z;
        leaf.bx[lane] = b.x, leaf.by[lane] = b.y, leaf.bz[lane] = b.z;
        leaf.patchA[lane] = segment.patchA, leaf.patchB[lane] = segment.patchB;
    }
    return leaf;
}

/// Where the range is parted: half way by `key` along its longest axis, and between two patches where there are
/// several.
Entries part(Entries first, Entries last, glm::dvec3 Entry::*key, bool betweenPatches) {
    Box box;
    for (auto entry = first; entry != last; ++entry) box.add((*entry).*key);
    const int axis = longestAxis(box.extent());
    std::stable_sort(first, last, [&](const Entry& a, const Entry& b) {
        const double x = (a.*key)[axis], y = (b.*key)[axis];
        return x != y ? x < y : betweenPatches && a.segment.patchA < b.segment.patchA;
    });
    const Entries middle = first + (last - first) / 2;
    if (!betweenPatches) return middle;
    const auto patch = middle->segment.patchA;
    Entries from = middle, to = middle;
    while (from != first && (from - 1)->segment.patchA == patch) --from;
    while (to != last && to->segment.patchA == patch) ++to;
    return from != first && (to == last || middle - from <= to - middle) ? from : to;
}

void build(Entries first, Entries last, BorderTree& tree) {
    const size_t index = tree.nodes.size();
    tree.nodes.push_back(nodeOf(first, last));
    const bool severalPatches =
        std::any_of(first, last, [&](const Entry& entry) { return entry.segment.patchA != first->segment.patchA; });
    const bool isLeaf = static_cast<size_t>(last - first) <= BORDER_LANES;
    // From the root down: the first node that is not parted between patches.
    if (isLeaf || !severalPatches)
        for (auto entry = first; entry != last; ++entry) {
            const unsigned patch = entry->segment.patchA;
            if (patch < tree.nodeOfPatch.size() && tree.nodeOfPatch[patch] == QL_NONE)
                tree.nodeOfPatch[patch] = static_cast<unsigned>(index);
        }
    if (isLeaf) {
        tree.nodes[index].leaf = static_cast<unsigned>(tree.leaves.size());
        tree.leaves.push_back(leafOf(first, last));
    } else {
        const Entries middle = part(first, last, severalPatches ? &Entry::group : &Entry::middle, severalPatches);
        build(first, middle, tree);
        build(middle, last, tree);
    }
    tree.nodes[index].next = static_cast<unsigned>(tree.nodes.size());
}

} // namespace

BorderTree buildBorderTree(const std::vector<BorderSegment>& segments, unsigned patchCount) {
    BorderTree tree;
    tree.segmentCount = segments.size();
    tree.nodeOfPatch.assign(patchCount, QL_NONE);
    std::vector<Entry> entries = entriesOf(segments);
    if (!entries.empty()) build(entries.begin(), entries.end(), tree);
    return tree;
}

} // namespace quasilux
