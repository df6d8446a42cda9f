// The tree that host/prepare/bvh.cpp builds: complete, nested, bounded in depth, and refused for unusable input.
#include "support/meshes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace quasilux {
namespace {

using Primitives = std::vector<BvhPrimitive>;

constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Bvh, HoldsEveryPrimitiveOnceWithinItsBoxes) {
    const Primitives primitives = awkwardPrimitives(3000, 16);
    const Bvh bvh = buildBvh(primitives);
    std::vector<unsigned> seen(primitives.size());
    unsigned deepest = 0;
    const auto visit = [&](auto&& self, unsigned index, const glm::vec3& lower, const glm::vec3& upper,
                           unsigned depth) -> void {
        deepest = std::max(deepest, depth);
        const shared::BvhNode& node = bvh.nodes[index];
        for (int i = 0; i < BVH_WIDTH; ++i) {
            if (node.lowerX[i] > node.upperX[i]) continue;
            const glm::vec3 low(node.lowerX[i], node.lowerY[i], node.lowerZ[i]),
                high(node.upperX[i], node.upperY[i], node.upperZ[i]);
            ASSERT_TRUE(glm::all(glm::lessThanEqual(lower, low)) && glm::all(glm::lessThanEqual(high, upper)));
            if (!(node.child[i] & BVH_LEAF_BIT)) {
                self(self, node.child[i], low, high, depth + 1);
                continue;
            }
            for (unsigned primitive : bvh.blocks.at(node.child[i] & BVH_LEAF_FIRST_MASK).primitive) {
                if (primitive == QL_NONE) continue;
                ++seen.at(primitive);
                for (const glm::vec3& v :
                     {primitives[primitive].v0, primitives[primitive].v1, primitives[primitive].v2})
                    ASSERT_TRUE(glm::all(glm::lessThanEqual(low, v)) && glm::all(glm::lessThanEqual(v, high)));
            }
        }
    };
    visit(visit, 0, glm::vec3(-infinity), glm::vec3(infinity), 1);
    EXPECT_EQ(seen, std::vector<unsigned>(primitives.size(), 1u));
    EXPECT_EQ(deepest, bvh.depth);
}

TEST(Bvh, ManyDuplicatesStayShallow) {
    const Bvh bvh = buildBvh(Primitives(100000, cornellBoxPrimitives()[0]));
    EXPECT_LE(bvh.depth, 32u);
    EXPECT_GE(bvh.blocks.size(), 12500u);
}

// The builder sees no way to split points on a line that is better than another one.
TEST(Bvh, PointsOnALineAreHeld) {
    Primitives primitives(200000, cornellBoxPrimitives()[0]);
    for (size_t i = 0; i < primitives.size(); ++i)
        primitives[i].v0 = primitives[i].v1 = primitives[i].v2 = glm::vec3(1e-3f * float(i), 0, 0);
    const Bvh bvh = buildBvh(primitives);
    EXPECT_GE(bvh.blocks.size(), 25000u);
    EXPECT_LE(bvh.depth, 256u) << "the stack of a ray grows by 7 entries a level";
}

TEST(Bvh, StackHoldsWhatTheDepthMayLeaveBehind) {
    Bvh bvh;
    for (bvh.depth = 1; bvh.depth <= 40; ++bvh.depth) {
        const std::string options = bvhOptions(bvh), name = "-DBVH_STACK_SIZE=";
        ASSERT_EQ(options.substr(0, name.size()), name);
        EXPECT_GE(std::stoul(options.substr(name.size())), 7 * bvh.depth + 1);
    }
}

TEST(Bvh, UnusableCoordinatesAreRefused) {
    for (const float bad : {std::nanf(""), infinity, -infinity, 3e12f}) {
        Primitives primitives = cornellBoxPrimitives();
        primitives[17].v1.y = bad;
        EXPECT_THROW(buildBvh(primitives), InputError);
    }
}

} // namespace
} // namespace quasilux
