// Patches, border edges and curvature, on surfaces whose borders can be counted by hand.
#include "prepare/borders.h"

#include "support/border_scenes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

TEST(Borders, CornellBox) {
    const SurfaceBorders borders = findBorders(cornellBox());
    EXPECT_EQ(borders.patchCount, 5u + 12u);
    ASSERT_EQ(borders.patchOfPrimitive.size(), 10u + 24u);
    EXPECT_EQ(borders.segments.size(), 12u + 24u);
    for (unsigned wall = 0; wall < 5; ++wall) EXPECT_EQ(borders.patchOfPrimitive[2 * wall], wall);
    // floor 0, ceiling 1, back 2, left 3, right 4: opposite walls do not meet, all others do, once
    for (unsigned p = 0; p < 5; ++p)
        for (unsigned q = p + 1; q < 5; ++q)
            EXPECT_EQ(countNaming(borders, p, q), (p == 0 && q == 1) || (p == 3 && q == 4) ? 0u : 1u) << p << " " << q;
    EXPECT_EQ(countNaming(borders, 0, QL_NONE), 1u);
    EXPECT_EQ(countNaming(borders, 2, QL_NONE), 0u);
    EXPECT_NEAR(totalLength(borders), 12 * 5.5 + 24 * 1.6, 1e-4);
    for (const float curvature : borders.patchCurvature) EXPECT_EQ(curvature, 0.0f);
}

TEST(Borders, CountsDoNotDependOnScaleAndPlace) {
    for (const double scale : {1e-4, 1.0, 1e5})
        for (const double offset : {0.0, 1e5}) {
            Scene scene = cornellBox();
            transform(scene, scale, scale * offset * dvec3(1, -1, 0.5));
            const SurfaceBorders borders = findBorders(scene);
            EXPECT_EQ(borders.patchCount, 17u) << scale << " " << offset;
            EXPECT_EQ(borders.segments.size(), 36u) << scale << " " << offset;
        }
}

TEST(Borders, SmoothSphereMeshIsOnePatch) {
    Scene scene;
    addSphereMesh(scene, {1, 2, 3}, 2, 48, 24);
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 1u);
    EXPECT_TRUE(borders.segments.empty());
    // near the poles the triangles are uneven and their curvature somewhat overestimated, which is the safe side
    EXPECT_GT(borders.patchCurvature[0], 0.495f);
    EXPECT_LT(borders.patchCurvature[0], 0.57f);
    // negative control: facets steeper than the crease angle are patches
    EXPECT_GT(findBorders(scene, 0.05).patchCount, 100u);
}

TEST(Borders, FinePlaneHasOnlyItsOutline) {
    Scene scene;
    addPlane(scene, {0.1, 0.2, 0.3}, {3, 1, 0}, {-1, 3, 0.5}, 71);
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 1u);
    EXPECT_EQ(borders.segments.size(), 4u * 71);
    EXPECT_NEAR(totalLength(borders), 2 * (std::sqrt(10.0) + std::sqrt(10.25)), 1e-4);
    EXPECT_EQ(borders.patchCurvature[0], 0.0f);
}

TEST(Borders, SpikeDoesNotSetTheCurvature) {
    Scene scene;
    addPlane(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 20);
    scene.shapes[0].mesh.positions[200].z = 0.01f;
    EXPECT_EQ(findBorders(scene).patchCount, 1u);
    EXPECT_EQ(findBorders(scene).patchCurvature[0], 0.0f);
}

TEST(Borders, CylinderWithCaps) {
    const unsigned slices = 60;
    const double radius = 0.5;
    for (const unsigned rings : {1u, 200u}) { // the curvature must not depend on the shape of the triangles
        std::vector<dvec3> positions{{0, 0, 0}, {0, 0, 2}};
        std::vector<glm::uvec3> triangles;
        const auto at = [&](unsigned ring, unsigned i) { return 2 + ring * slices + i % slices; };
        for (unsigned ring = 0; ring <= rings; ++ring)
            for (unsigned i = 0; i < slices; ++i)
                positions.push_back({radius * std::cos(2 * pi * i / slices), radius * std::sin(2 * pi * i / slices),
                                     2.0 * ring / rings});
        for (unsigned i = 0; i < slices; ++i) {
            triangles.insert(triangles.end(), {{0, at(0, i + 1), at(0, i)}, {1, at(rings, i), at(rings, i + 1)}});
            for (unsigned r = 0; r < rings; ++r)
                triangles.insert(triangles.end(), {{at(r, i), at(r, i + 1), at(r + 1, i + 1)},
                                                   {at(r, i), at(r + 1, i + 1), at(r + 1, i)}});
        }
        Scene scene;
        addMesh(scene, positions, triangles);
        const SurfaceBorders borders = findBorders(scene);
        EXPECT_EQ(borders.patchCount, 3u);
        EXPECT_EQ(borders.segments.size(), 2u * slices);
        EXPECT_NEAR(totalLength(borders), 2 * slices * 2 * radius * std::sin(pi / slices), 1e-4);
        const unsigned side = borders.patchOfPrimitive[2];
        EXPECT_EQ(countNaming(borders, borders.patchOfPrimitive[0], side), slices);
        EXPECT_NEAR(borders.patchCurvature[side], 1 / radius, 0.05 / radius);
        EXPECT_NEAR(borders.patchCurvature[borders.patchOfPrimitive[0]], 0, 1e-3);
    }
}

TEST(Borders, FlippedWindingIsABorder) {
    Scene scene;
    addPlane(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addPlane(scene, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}); // normal -z
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 2u);
    EXPECT_EQ(borders.segments.size(), 7u);
    EXPECT_EQ(countNaming(borders, 0, 1), 1u);

    // Folded back over itself with the winding turned: the normals agree, yet the surface does not go on.
    Scene folded;
    addPlane(folded, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addPlane(folded, {0, 0, 0}, {1, 0, 0.1}, {0, 1, 0});
    EXPECT_EQ(findBorders(folded).patchCount, 2u);
    EXPECT_EQ(findBorders(folded).segments.size(), 7u);

    Scene joined;
    addPlane(joined, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addPlane(joined, {1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(findBorders(joined).patchCount, 1u);
    EXPECT_EQ(findBorders(joined).segments.size(), 6u);
}

TEST(Borders, ThreeSheetsAtOneEdgeAreAllNamed) {
    Scene scene;
    addPlane(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addPlane(scene, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0});
    addPlane(scene, {0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 3u);
    EXPECT_EQ(borders.segments.size(), 9u + 2u);
    std::set<unsigned> named;
    for (const auto& segment : borders.segments)
        if (segment.a.x == 0 && segment.b.x == 0 && segment.a.z == 0 && segment.b.z == 0)
            named.insert({segment.patchA, segment.patchB});
    EXPECT_EQ(named, (std::set<unsigned>{0, 1, 2, QL_NONE}));
}

// What lies on one half of a disc says nothing of the other where other photons are stored, or none.
TEST(Borders, MaterialsThatStoreOtherPhotonsDoNotJoin) {
    const auto patches = [](double width, double widthOfOther, bool isBent) {
        Scene scene;
        addPlane(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
        addPlane(scene, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0});
        for (const double halfWidth : {width, widthOfOther}) {
            Bsdf& bsdf = scene.bsdfs.emplace_back();
            if (halfWidth >= 0) bsdf.front.emplace_back().halfWidth = halfWidth;
            scene.shapes[scene.bsdfs.size() - 1].bsdf = int(scene.bsdfs.size()) - 1;
        }
        if (isBent) scene.bsdfs[1].frontRelief.emplace();
        const SurfaceBorders borders = findBorders(scene);
        EXPECT_EQ(borders.segments.size(), borders.patchCount == 1 ? 6u : 7u);
        return borders.patchCount;
    };
    constexpr double lambert = pi / 4, wide = 0.4, narrow = 0.1, specular = 0, none = -1;
    EXPECT_EQ(patches(lambert, lambert, false), 1u);
    EXPECT_EQ(patches(lambert, wide, false), 1u);
    for (const double other : {narrow, specular, none}) EXPECT_EQ(patches(lambert, other, false), 2u) << other;
    EXPECT_EQ(patches(specular, none, false), 1u) << "neither stores any";
    EXPECT_EQ(patches(lambert, lambert, true), 2u);
}

/// Every triangle with vertices of its own, each moved by `shift` along x.
Scene looseTriangles(const Scene& scene, const std::function<float(float)>& shift) {
    Scene loose;
    Mesh& mesh = loose.shapes.emplace_back().mesh;
    for (const glm::uvec3& t : scene.shapes[0].mesh.triangles) {
        const auto first = unsigned(mesh.positions.size());
        for (int k = 0; k < 3; ++k) {
            mesh.positions.push_back(scene.shapes[0].mesh.positions[t[k]]);
            mesh.positions.back().x = shift(mesh.positions.back().x);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return loose;
}

TEST(Borders, VerticesThatCoincideAreOne) {
    Scene scene;
    addPlane(scene, {3, 5, 1}, {1, 0, 0}, {0, 1, 0}, 10);
    std::mt19937 random(7);
    const auto same = [](float x) { return x; };
    const auto oneUlp = [&](float x) { return random() % 2 ? std::nextafter(x, 1e9f) : x; };
    const auto far = [&](float x) { return random() % 2 ? x + 1e-3f : x; };
    for (const std::function<float(float)>& shift :
         {std::function<float(float)>(same), std::function<float(float)>(oneUlp)}) {
        const SurfaceBorders borders = findBorders(looseTriangles(scene, shift));
        EXPECT_EQ(borders.patchCount, 1u);
        EXPECT_EQ(borders.segments.size(), 40u);
    }
    EXPECT_GT(findBorders(looseTriangles(scene, far)).patchCount, 10u); // negative control
}

TEST(Borders, DegenerateAndDoubledTriangles) {
    Scene scene;
    addPlane(scene, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Mesh& mesh = scene.shapes[0].mesh;
    mesh.positions.push_back({0.5f, 0.0f, 0.0f});
    mesh.triangles.insert(mesh.triangles.end(), {{0, 0, 1}, {0, 1, 4}, {2, 2, 2}, {0, 1, 3}, {3, 1, 0}});
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.segments.size(), 4u);
    EXPECT_EQ(borders.patchCount, 2u); // the plane, and the triangle of one point
    const unsigned plane = borders.patchOfPrimitive[0];
    EXPECT_EQ(borders.patchOfPrimitive, (std::vector<unsigned>{plane, plane, plane, plane, 1, plane, plane}));
}

TEST(Borders, NullShapesAreNoBorders) {
    for (const bool isNull : {true, false}) {
        Scene scene;
        scene.bsdfs.resize(1);
        scene.bsdfs[0].isNull = isNull;
        addPlane(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0});
        addCube(scene, glm::dmat4(1));
        addSphere(scene, {1.5, 0, 0}, 1);
        scene.shapes[1].bsdf = scene.shapes[2].bsdf = 0;
        const SurfaceBorders borders = findBorders(scene);
        EXPECT_EQ(borders.patchCount, isNull ? 3u : 8u);
        EXPECT_EQ(borders.segments.size() == 4, isNull);
        ASSERT_EQ(borders.patchOfPrimitive.size(), 15u);
    }
}

TEST(Borders, EmptySceneHasNone) {
    const SurfaceBorders empty = findBorders(Scene{});
    EXPECT_EQ(empty.patchCount, 0u);
    EXPECT_TRUE(empty.segments.empty());
}

TEST(Borders, LargeMesh) {
    Scene scene;
    addSphereMesh(scene, {0, 0, 0.9}, 1, 450, 225);
    addPlane(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
    const auto start = std::chrono::steady_clock::now();
    const SurfaceBorders borders = findBorders(scene);
    const auto found = std::chrono::steady_clock::now();
    std::printf("%zu primitives, %zu segments: found in %.2f s\n", borders.patchOfPrimitive.size(),
                borders.segments.size(), std::chrono::duration<double>(found - start).count());
    EXPECT_EQ(borders.patchCount, 2u);
    EXPECT_NEAR(totalLength(borders), 40 + 2 * pi * std::sqrt(1 - 0.81), 1e-3);
}

// ---- sheets in one plane

TEST(Overlaps, AreOfTrianglesThatLieInOnePlaneAndFaceTheSameWay) {
    const auto overlapOf = [](dvec3 corner, dvec3 u, dvec3 v, const glm::dmat4& toWorld) {
        Scene scene;
        const auto at = [&](dvec3 p, double w) { return dvec3(toWorld * glm::dvec4(p, w)); };
        addPlane(scene, at({0, 0, 0}, 1), at({1, 0, 0}, 0), at({0, 1, 0}, 0));
        addPlane(scene, at(corner, 1), at(u, 0), at(v, 0));
        return findBorders(scene).overlap;
    };
    const glm::dmat4 turned = glm::rotate(glm::translate(glm::dmat4(1), {5, 6, 7}), 0.7, {1, 2, 3});
    for (const glm::dmat4& toWorld : {glm::dmat4(1), turned}) {
        const auto overlap = overlapOf({0.5, 0.25, 0}, {1, 0, 0}, {0, 1, 0}, toWorld);
        ASSERT_TRUE(overlap);
        EXPECT_LT(overlap->first, 2u);
        EXPECT_GE(overlap->second, 2u);
        const dvec3 place = glm::inverse(toWorld) * glm::dvec4(overlap->place, 1);
        EXPECT_TRUE(place.x > 0.5 && place.x < 1 && place.y > 0.25 && place.y < 1) << place.x << ' ' << place.y;
        EXPECT_TRUE(overlapOf({0.25, 0.25, 0}, {0.5, 0, 0}, {0, 0.5, 0}, toWorld)) << "one within the other";
        EXPECT_FALSE(overlapOf({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, toWorld)) << "one and the same";
        EXPECT_FALSE(overlapOf({0.5, 0.25, 0}, {0, 1, 0}, {1, 0, 0}, toWorld)) << "the other way round";
        EXPECT_FALSE(overlapOf({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, toWorld)) << "side by side";
        EXPECT_FALSE(overlapOf({0.5, 0.25, 0.001}, {1, 0, 0}, {0, 1, 0}, toWorld)) << "apart";
        EXPECT_FALSE(overlapOf({0.5, 0.25, 0}, {1, 0, 0.01}, {0, 1, 0}, toWorld)) << "at an angle";
    }
}

TEST(Overlaps, NoneInASmoothMesh) {
    Scene scene;
    addPlane(scene, {-2, -2, 0}, {4, 0.3, 0.1}, {0.2, 4, 0.7}, 40);
    EXPECT_FALSE(findBorders(scene).overlap);
}

} // namespace
} // namespace quasilux
