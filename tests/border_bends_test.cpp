// Smooth bodies whose flat regions go on into each other round narrow bends: these are patches of their own.
#include "support/border_scenes.h"
#include "support/rounded_board.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

/// A grid of `cells` x `cells` squares over [-1, 1]^2, moved by `height` along z.
Scene relief(unsigned cells, const std::function<double(double, double)>& height) {
    Scene scene;
    addPlane(scene, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, cells);
    for (glm::vec3& p : scene.shapes[0].mesh.positions) p.z = float(height(p.x, p.y));
    return scene;
}

Scene board(double thickness, unsigned steps) {
    Scene scene;
    scene.shapes.emplace_back().mesh = test::roundedBoard(thickness, steps);
    return scene;
}

TEST(BorderBends, FacesOfARoundedBoardArePatches) {
    for (const unsigned steps : {10u, 11u, 40u})
        for (const double thickness : {0.1, 0.02}) {
            const SurfaceBorders borders = findBorders(board(thickness, steps));
            EXPECT_EQ(borders.patchCount, 6u) << steps; // two faces, two rims, two caps
            const unsigned rim = borders.patchOfPrimitive[0], face = borders.patchOfPrimitive[2 * steps];
            EXPECT_EQ(countNaming(borders, rim, face), 1u);
            EXPECT_NEAR(totalLength(borders), 4 * 2 + 2 * (4 + pi * thickness), 0.01);
            EXPECT_LT(borders.patchCurvature[face], 0.5);
            EXPECT_NEAR(borders.patchCurvature[rim] * thickness / 2, 1, 0.03);
        }
    // Where the rims are more than a tenth of the area the radius is that of the rims, and no disc reaches round one.
    EXPECT_EQ(findBorders(board(0.4, 20)).patchCount, 3u);
}

// Coarse steps are creases already: of six pairs of triangles about a rim the outer ones join the faces, half a step away.
TEST(BorderBends, CreasesStayBorders) { EXPECT_EQ(findBorders(board(0.1, 6)).patchCount, 2u + 2u * 4u + 2u); }

// A ridge between two planes: the narrower it is the more it is a bend.
TEST(BorderBends, AWideCurveIsNone) {
    const auto roof = [](double radius) { // planes that fall by half on either side of a cylinder along y
        return relief(100, [=](double x, double) {
            const double s = std::abs(x), end = radius / std::sqrt(5.0); // where the cylinder's slope is 1/2
            return s < end ? std::sqrt(radius * radius - s * s)
                           : std::sqrt(radius * radius - end * end) - 0.5 * (s - end);
        });
    };
    EXPECT_EQ(findBorders(roof(0.15)).patchCount, 3u);
    EXPECT_EQ(findBorders(roof(1.8)).patchCount, 1u);
}

TEST(BorderBends, DentsAndSpikesAreNone) {
    const auto bump = [](double height) {
        return relief(100, [=](double x, double y) { return height * std::exp(-(x * x + y * y) / 0.005); });
    };
    for (const double height : {0.02, -0.02}) EXPECT_EQ(findBorders(bump(height)).patchCount, 1u);
    // A finger turns as much as a whole sphere. (Where it is steep its triangles are creases.)
    EXPECT_GT(findBorders(bump(0.2), 3).patchCount, 1u);
}

TEST(BorderBends, RoughnessIsNone) {
    unsigned state = 1;
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) / 4294967296.0 - 0.5; };
    for (const double height : {1e-7, 1e-5, 1e-3})
        EXPECT_EQ(findBorders(relief(60, [&](double, double) { return height * random(); })).patchCount, 1u) << height;
}

} // namespace
} // namespace quasilux
