// Curves where surfaces cut each other: lengths known in closed form, and brute force on random triangles.
#include "prepare/border_intersections.h"
#include "prepare/border_pairs.h"
#include "prepare/borders.h"
#include "support/border_scenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>

namespace quasilux {
namespace {

TEST(BorderCuts, CubeSunkIntoAFloor) {
    for (const unsigned cells : {1u, 37u})
        for (const double scale : {1e-4, 1.0, 1e5}) {
            Scene scene;
            addPlane(scene, dvec3(-2, -2, 0) * scale, dvec3(4, 0, 0) * scale, dvec3(0, 4, 0) * scale, cells);
            glm::dmat4 m = glm::rotate(glm::scale(glm::dmat4(1), dvec3(0.5 * scale)), 0.4, dvec3(0, 0, 1));
            addCube(scene, m);
            const SurfaceBorders borders = findBorders(scene);
            EXPECT_EQ(borders.patchCount, 7u);
            EXPECT_NEAR(totalLength(borders) / scale, 16 + 12 + 4, 1e-5 * 4);
            for (unsigned face = 0; face < 6; ++face) // two of them, top and bottom, do not meet the floor
                EXPECT_EQ(countNaming(borders, 0, 1 + face) == 0, face >= 4);
        }
}

TEST(BorderCuts, CutAlongARowOfEdgesIsFoundOnce) {
    Scene scene;
    addPlane(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 9);
    addSphereMesh(scene, {0, 0, 0}, 1, 40, 20);
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 2u);
    EXPECT_NEAR(totalLength(borders), 16 + 80 * std::sin(pi / 40), 1e-5);
}

TEST(BorderCuts, SheetThatPassesThroughItself) {
    // A band, smooth throughout, whose two ends cross: one patch that borders itself.
    Scene scene;
    std::vector<dvec3> positions;
    std::vector<glm::uvec3> triangles;
    const unsigned pieces = 40;
    for (unsigned i = 0; i <= pieces; ++i) {
        const double t = 1.2 * pi * (2.0 * i / pieces - 1); // a loop: x = sin t, y = sin(t / 2) ... crosses at x = 0
        for (const double z : {0.0, 1.0})
            positions.push_back({std::sin(t), 0.5 * t * t / (pi * pi) - 0.5 * std::cos(t), z});
    }
    for (unsigned i = 0; i < pieces; ++i)
        triangles.insert(triangles.end(), {{2 * i, 2 * i + 2, 2 * i + 3}, {2 * i, 2 * i + 3, 2 * i + 1}});
    addMesh(scene, positions, triangles);
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 1u);
    double crossing = 0;
    for (const auto& segment : borders.segments)
        if (segment.patchA == 0 && segment.patchB == 0) crossing += length(segment);
    EXPECT_NEAR(crossing, 1.0, 1e-5);
}

TEST(BorderCuts, SpheresCutPlanesAndSpheres) {
    const double chord = std::sin(pi / 128) / (pi / 128); // chords to arc
    for (const unsigned cells : {1u, 13u}) {
        Scene scene;
        addPlane(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, cells);
        addSphere(scene, {0.1, 0.2, 0.6}, 1);
        const SurfaceBorders borders = findBorders(scene);
        EXPECT_EQ(borders.patchCount, 2u);
        EXPECT_FLOAT_EQ(borders.patchCurvature[1], 1.0f);
        const double arc = 2 * pi * 0.8;
        EXPECT_LT(totalLength(borders), 16 + arc + 1e-5);
        EXPECT_GT(totalLength(borders), 16 + arc * chord - 1e-5);
        for (const auto& segment : borders.segments)
            if (names(segment, 0, 1)) {
                EXPECT_NEAR(glm::distance(point(segment.a), dvec3(0.1, 0.2, 0)), 0.8, 1e-5);
            }
    }
    Scene pair;
    addSphere(pair, {0, 0, 0}, 5);
    addSphere(pair, {6, 0, 0}, 5);
    EXPECT_EQ(findBorders(pair).segments.size(), 128u);
    EXPECT_NEAR(totalLength(findBorders(pair)), 2 * pi * 4 * chord, 1e-4);

    Scene apart; // inside each other, touching, standing on a plane: no circle
    addSphere(apart, {0, 0, 1}, 1);
    addSphere(apart, {0, 0, 1}, 0.5);
    addSphere(apart, {2, 0, 1}, 1);
    addPlane(apart, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
    EXPECT_EQ(findBorders(apart).segments.size(), 4u);
}

/// Points where the edges of `a` pass through `b`.
void edgeHits(const SurfaceTriangle& a, const SurfaceTriangle& b, const Surface& surface, std::vector<dvec3>& hits) {
    for (int i = 0; i < 3; ++i) {
        const dvec3 p = surface.vertices[a.corner[i]], q = surface.vertices[a.corner[(i + 1) % 3]];
        const dvec3 v0 = surface.vertices[b.corner[0]], e1 = surface.vertices[b.corner[1]] - v0,
                    e2 = surface.vertices[b.corner[2]] - v0;
        const dvec3 solution = glm::inverse(glm::dmat3(e1, e2, p - q)) * (p - v0);
        if (solution.x >= 0 && solution.y >= 0 && solution.x + solution.y <= 1 && solution.z >= 0 && solution.z <= 1)
            hits.push_back(glm::mix(p, q, solution.z));
    }
}

TEST(BorderCuts, RandomTrianglesCutWhereTheirEdgesHit) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1, 1);
    size_t cutCount = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Scene scene;
        std::vector<dvec3> positions;
        for (int i = 0; i < 6; ++i) positions.push_back({uniform(random), uniform(random), uniform(random)});
        addMesh(scene, positions, {{0, 1, 2}, {3, 4, 5}});
        const Surface surface = collectSurface(scene, scene.shapes);
        const SurfaceTriangle &a = surface.triangles[0], &b = surface.triangles[1];
        std::vector<dvec3> hits;
        edgeHits(a, b, surface, hits);
        edgeHits(b, a, surface, hits);
        const std::optional<CutSegment> cut = cutTriangles(surface, a, b);
        if (hits.size() == 2 && glm::distance(hits[0], hits[1]) < 1e-5)
            continue; // near the tolerance either answer is right
        ASSERT_EQ(cut.has_value(), hits.size() == 2);
        if (cut) {
            ++cutCount;
            const double straight = glm::distance(cut->a, hits[0]) + glm::distance(cut->b, hits[1]);
            const double crossed = glm::distance(cut->a, hits[1]) + glm::distance(cut->b, hits[0]);
            ASSERT_LT(std::min(straight, crossed), 1e-9);
        }
    }
    EXPECT_GT(cutCount, 1000u);
}

TEST(BorderCuts, OverlappingPairsAreThoseOfBruteForce) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Box> boxes(2000);
    for (Box& box : boxes) { // sizes over three decades
        box.lower = {uniform(random), uniform(random), uniform(random)};
        box.upper = box.lower +
                    std::pow(10, -3 * uniform(random)) * 0.3 * dvec3(uniform(random), uniform(random), uniform(random));
    }
    std::multiset<std::pair<unsigned, unsigned>> found, expected;
    forEachOverlappingPair(boxes, [&](unsigned i, unsigned j) { found.insert({i, j}); });
    for (unsigned i = 0; i < boxes.size(); ++i)
        for (unsigned j = i + 1; j < boxes.size(); ++j)
            if (boxes[i].overlaps(boxes[j])) expected.insert({i, j});
    EXPECT_GT(expected.size(), 500u);
    EXPECT_EQ(found, expected);
}

} // namespace
} // namespace quasilux
