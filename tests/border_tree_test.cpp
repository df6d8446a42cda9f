// The tree over border segments: what a walk through it relies on. What kernels find in it: density_test.cpp.
#include "prepare/border_tree.h"

#include "prepare/pack.h"
#include "support/border_scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

namespace quasilux {
namespace {

using glm::dvec3;
using Segments = std::vector<BorderSegment>;

/// Those of a leaf; other places of it have no length.
Segments segmentsOf(const shared::BorderLeaf& leaf) {
    Segments segments;
    for (unsigned k = 0; k < BORDER_LANES; ++k) {
        const shared::Packed3 a{leaf.ax[k], leaf.ay[k], leaf.az[k]}, b{leaf.bx[k], leaf.by[k], leaf.bz[k]};
        if (unpack(a) != unpack(b)) segments.push_back({a, b, leaf.patchA[k], leaf.patchB[k]});
    }
    return segments;
}

Segments allSegments(const BorderTree& tree) {
    Segments segments;
    for (const auto& leaf : tree.leaves)
        for (const auto& segment : segmentsOf(leaf)) segments.push_back(segment);
    return segments;
}

/// Walks down from `index`; returns the first node that is not below it. `wrong` counts what breaks the tree's
/// promises.
unsigned checkBelow(const BorderTree& tree, unsigned index, std::vector<unsigned>& held, unsigned& wrong) {
    const shared::BorderNode& node = tree.nodes[index];
    unsigned next = index + 1;
    std::vector<unsigned> below;
    if (node.leaf != QL_NONE)
        below.push_back(node.leaf);
    else
        for (int child = 0; child < 2; ++child) next = checkBelow(tree, next, below, wrong);
    wrong += node.next != next;
    Segments segments;
    for (const unsigned leaf : below)
        for (const auto& segment : segmentsOf(tree.leaves[leaf])) segments.push_back(segment);
    for (const auto& segment : segments) {
        for (const auto& end : {segment.a, segment.b}) {
            wrong += glm::distance(unpack(end), unpack(node.center)) > node.radius;
            wrong += glm::any(glm::greaterThan(glm::abs(unpack(end) - unpack(node.center)), unpack(node.halfExtent)));
        }
        for (const unsigned patch : {segment.patchA, segment.patchB})
            wrong += patch != QL_NONE && (patch < node.patchFirst || patch > node.patchLast);
    }
    held.insert(held.end(), below.begin(), below.end());
    return next;
}

bool isBelow(const BorderTree& tree, unsigned leaf, unsigned node) {
    for (unsigned n = node; n < tree.nodes[node].next; ++n)
        if (tree.nodes[n].leaf == leaf) return true;
    return false;
}

unsigned mistakesOf(const BorderTree& tree) {
    std::vector<unsigned> held;
    unsigned wrong = 0;
    const unsigned end = checkBelow(tree, 0, held, wrong);
    wrong += end != tree.nodes.size();
    std::sort(held.begin(), held.end());
    for (unsigned k = 0; k < tree.leaves.size(); ++k) {
        wrong += k >= held.size() || held[k] != k;
        for (const auto& segment : segmentsOf(tree.leaves[k])) {
            const unsigned node = tree.nodeOfPatch[segment.patchA];
            wrong += node == QL_NONE || !isBelow(tree, k, node);
        }
    }
    return wrong;
}

auto asTuple(const BorderSegment& s) {
    return std::tuple{s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z, s.patchA, s.patchB};
}

bool areTheSame(Segments a, Segments b) {
    const auto less = [](const auto& x, const auto& y) { return asTuple(x) < asTuple(y); };
    std::sort(a.begin(), a.end(), less);
    std::sort(b.begin(), b.end(), less);
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return asTuple(x) == asTuple(y); });
}

/// Rims of `count` round leaves, 64 segments each, one above the other.
Segments leaves(unsigned count) {
    Segments segments;
    for (unsigned leaf = 0; leaf < count; ++leaf)
        for (unsigned k = 0; k < 64; ++k) {
            const auto at = [&](unsigned step) {
                const double angle = 2 * pi * step / 64;
                return pack(dvec3(std::cos(angle), std::sin(angle), 0.2 * leaf));
            };
            segments.push_back({at(k), at(k + 1), leaf, QL_NONE});
        }
    return segments;
}

TEST(BorderTree, HoldsEachSegmentInOneLeafAndInAllBoxesAbove) {
    for (const double offset : {0.0, 1e4}) {
        Scene scene = cornellBox();
        addSphere(scene, {2, 0.3, 2}, 1);
        addCube(scene, glm::rotate(glm::translate(glm::dmat4(1), {3, 3, 3}), 0.7, {1, 2, 3}));
        transform(scene, 1, dvec3(offset));
        for (const Segments& segments : {findBorders(scene).segments, leaves(30)}) {
            BorderTree tree = buildBorderTree(segments, 200);
            EXPECT_TRUE(areTheSame(segments, allSegments(tree)));
            EXPECT_EQ(mistakesOf(tree), 0u);
            // Negative controls: a box that is too small, a patch that is not named, a wrong next node.
            BorderTree wrong = tree;
            wrong.nodes[0].halfExtent.x *= 0.9f;
            EXPECT_GT(mistakesOf(wrong), 0u);
            wrong = tree;
            --wrong.nodes[0].patchLast;
            EXPECT_GT(mistakesOf(wrong), 0u);
            wrong = tree;
            ++wrong.nodes[1].next;
            EXPECT_GT(mistakesOf(wrong), 0u);
            wrong = tree;
            wrong.nodeOfPatch[tree.leaves[0].patchA[0]] = tree.nodeOfPatch[tree.leaves.back().patchA[0]];
            EXPECT_GT(mistakesOf(wrong), 0u);
        }
    }
}

// A walk that takes one patch only passes by the others, also where they lie in one place.
TEST(BorderTree, PartsPatches) {
    const BorderTree tree = buildBorderTree(leaves(100), 100);
    unsigned visited = 0;
    for (unsigned n = 0; n < tree.nodes.size(); ++visited) {
        const auto& node = tree.nodes[n];
        n = node.patchFirst <= 42 && 42 <= node.patchLast ? n + 1 : node.next;
    }
    EXPECT_LT(visited, 50u); // of about 2,000: those of one rim, and two for each level above
    EXPECT_GT(visited, 20u);
}

TEST(BorderTree, OfNothingIsEmpty) { EXPECT_TRUE(buildBorderTree({}, 0).nodes.empty()); }

} // namespace
} // namespace quasilux
