// Patches, border segments, cuts and the grid over them, on surfaces whose borders can be counted by hand.
#include "prepare/border_intersections.h"
#include "prepare/border_pairs.h"
#include "prepare/borders.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>

namespace quasilux {
namespace {

constexpr double pi = 3.14159265358979323846;
using glm::dvec3;

void addMesh(Scene& scene, const std::vector<dvec3>& positions, const std::vector<glm::uvec3>& triangles,
             const glm::dmat4& toWorld = glm::dmat4(1)) {
    ShapeDescription& shape = scene.shapes.emplace_back();
    for (const dvec3& p : positions) shape.mesh.positions.emplace_back(dvec3(toWorld * glm::dvec4(p, 1)));
    shape.mesh.triangles = triangles;
}

/// cells x cells squares, two triangles each, normal u x v.
void addPlane(Scene& scene, dvec3 corner, dvec3 u, dvec3 v, unsigned cells = 1) {
    std::vector<dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (unsigned j = 0; j <= cells; ++j)
        for (unsigned i = 0; i <= cells; ++i)
            positions.push_back(corner + u * (double(i) / cells) + v * (double(j) / cells));
    for (unsigned j = 0; j < cells; ++j)
        for (unsigned i = 0; i < cells; ++i) {
            const unsigned a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
            triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
        }
    addMesh(scene, positions, triangles);
}

/// [-1, 1]^3 with four vertices of its own to each face, normals outwards.
void addCube(Scene& scene, const glm::dmat4& toWorld) {
    std::vector<dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            dvec3 n(0), u(0), v(0);
            n[axis] = sign;
            u[(axis + 1) % 3] = sign;
            v[(axis + 2) % 3] = 1;
            const auto first = unsigned(positions.size());
            positions.insert(positions.end(), {n - u - v, n + u - v, n + u + v, n - u + v});
            triangles.insert(triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
        }
    addMesh(scene, positions, triangles, toWorld);
}

/// Latitude-longitude mesh; an even number of rings has one in the plane z = 0.
void addSphereMesh(Scene& scene, dvec3 center, double radius, unsigned slices, unsigned rings) {
    std::vector<dvec3> positions{center + dvec3(0, 0, radius)};
    std::vector<glm::uvec3> triangles;
    for (unsigned j = 1; j < rings; ++j)
        for (unsigned i = 0; i < slices; ++i) {
            const double theta = pi * j / rings, phi = 2 * pi * i / slices;
            const double z = 2 * j == rings ? 0 : std::cos(theta);
            positions.push_back(center +
                                radius * dvec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), z));
        }
    positions.push_back(center - dvec3(0, 0, radius));
    const auto south = unsigned(positions.size() - 1);
    const auto at = [&](unsigned j, unsigned i) { return 1 + (j - 1) * slices + i % slices; };
    for (unsigned i = 0; i < slices; ++i) {
        triangles.push_back({0, at(1, i), at(1, i + 1)});
        for (unsigned j = 1; j + 1 < rings; ++j)
            triangles.insert(triangles.end(),
                             {{at(j, i), at(j + 1, i), at(j + 1, i + 1)}, {at(j, i), at(j + 1, i + 1), at(j, i + 1)}});
        triangles.push_back({at(rings - 1, i), south, at(rings - 1, i + 1)});
    }
    addMesh(scene, positions, triangles);
}

void addSphere(Scene& scene, dvec3 center, double radius) {
    scene.shapes.emplace_back().sphere = Sphere{glm::vec3(center), float(radius)};
}

/// Room of 5.5 units, open towards +z, with two turned cubes that stand on its floor.
Scene cornellBox() {
    Scene scene;
    const dvec3 x(5.5, 0, 0), y(0, 5.5, 0), z(0, 0, 5.5), o(0);
    addPlane(scene, o, z, x);
    addPlane(scene, y, x, z);
    addPlane(scene, o, x, y);
    addPlane(scene, o, y, z);
    addPlane(scene, x, z, y);
    for (const double side : {1.0, -1.0}) {
        glm::dmat4 m = glm::translate(glm::dmat4(1), dvec3(2.75 + side * 1.2, 0.8, 2.75));
        m = glm::rotate(m, side * 0.3, dvec3(0, 1, 0));
        addCube(scene, glm::scale(m, dvec3(0.8)));
    }
    return scene;
}

dvec3 point(const shared::Packed3& p) { return {p.x, p.y, p.z}; }
double length(const shared::BorderSegment& s) { return glm::distance(point(s.a), point(s.b)); }

double totalLength(const SurfaceBorders& borders) {
    double sum = 0;
    for (const auto& segment : borders.segments) sum += length(segment);
    return sum;
}

bool names(const shared::BorderSegment& s, unsigned p, unsigned q) {
    return (s.patchA == p && s.patchB == q) || (s.patchA == q && s.patchB == p);
}

size_t countNaming(const SurfaceBorders& borders, unsigned p, unsigned q) {
    size_t count = 0;
    for (const auto& segment : borders.segments) count += names(segment, p, q);
    return count;
}

void transform(Scene& scene, double scale, dvec3 offset) {
    for (ShapeDescription& shape : scene.shapes)
        for (glm::vec3& p : shape.mesh.positions) p = glm::vec3(dvec3(p) * scale + offset);
}

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

TEST(Borders, CubeSunkIntoAFloor) {
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

TEST(Borders, CutAlongARowOfEdgesIsFoundOnce) {
    Scene scene;
    addPlane(scene, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 9);
    addSphereMesh(scene, {0, 0, 0}, 1, 40, 20);
    const SurfaceBorders borders = findBorders(scene);
    EXPECT_EQ(borders.patchCount, 2u);
    EXPECT_NEAR(totalLength(borders), 16 + 80 * std::sin(pi / 40), 1e-5);
}

TEST(Borders, SheetThatPassesThroughItself) {
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

TEST(Borders, SpheresCutPlanesAndSpheres) {
    const double chord = std::sin(pi / 32) / (pi / 32); // chords to arc
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
    EXPECT_EQ(findBorders(pair).segments.size(), 32u);
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

TEST(Borders, RandomTrianglesCutWhereTheirEdgesHit) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1, 1);
    size_t cutCount = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Scene scene;
        std::vector<dvec3> positions;
        for (int i = 0; i < 6; ++i) positions.push_back({uniform(random), uniform(random), uniform(random)});
        addMesh(scene, positions, {{0, 1, 2}, {3, 4, 5}});
        const Surface surface = collectSurface(scene);
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

TEST(Borders, OverlappingPairsAreThoseOfBruteForce) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<BorderBox> boxes(2000);
    for (BorderBox& box : boxes) { // sizes over three decades
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

double distanceToSegment(const dvec3& p, const shared::BorderSegment& s) {
    const dvec3 a = point(s.a), along = point(s.b) - a;
    const double t = std::clamp(glm::dot(p - a, along) / std::max(1e-300, glm::dot(along, along)), 0.0, 1.0);
    return glm::distance(p, a + t * along);
}

/// Points near the segments for which the grid does not list a segment within `reach`; the cell is found as a kernel
/// would.
size_t countMissed(const SurfaceBorders& borders, const SurfaceBorders::Grid& grid, float reach, size_t& near) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(-1, 1), share(0, 1);
    size_t missed = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const auto& s = borders.segments[random() % borders.segments.size()];
        const glm::vec3 p = glm::vec3(glm::mix(point(s.a), point(s.b), share(random))) +
                            1.5f * reach * glm::vec3(uniform(random), uniform(random), uniform(random));
        std::set<unsigned> listed;
        const glm::vec3 cell = glm::floor((p - grid.lower) / grid.cellSize);
        if (glm::all(glm::greaterThanEqual(cell, glm::vec3(0))) &&
            glm::all(glm::lessThan(cell, glm::vec3(grid.cells)))) {
            const size_t index = (size_t(cell.z) * grid.cells.y + size_t(cell.y)) * grid.cells.x + size_t(cell.x);
            listed.insert(grid.items.begin() + grid.cellStart[index], grid.items.begin() + grid.cellStart[index + 1]);
        }
        for (unsigned i = 0; i < borders.segments.size(); ++i)
            if (distanceToSegment(p, borders.segments[i]) <= reach) {
                ++near;
                missed += !listed.count(i);
            }
    }
    return missed;
}

TEST(Borders, GridListsAllSegmentsWithinReach) {
    for (const double offset : {0.0, 1e4}) {
        Scene scene = cornellBox();
        addSphere(scene, {2, 0.3, 2}, 1);
        addCube(scene, glm::rotate(glm::translate(glm::dmat4(1), {3, 3, 3}), 0.7, {1, 2, 3}));
        transform(scene, 1, dvec3(offset));
        const SurfaceBorders borders = findBorders(scene);
        for (const float reach : {0.02f, 0.3f, 2.0f, 50.0f}) {
            size_t near = 0, nearHalved = 0;
            const SurfaceBorders::Grid grid = indexBorders(borders, reach);
            EXPECT_EQ(countMissed(borders, grid, reach, near), 0u) << reach;
            EXPECT_GT(near, 1000u);
            EXPECT_LE(double(grid.cells.x) * grid.cells.y * grid.cells.z, 2e6);
            if (reach == 0.3f) { // negative control: a grid for half the reach misses some
                EXPECT_GT(countMissed(borders, indexBorders(borders, reach / 2), reach, nearHalved), 0u) << reach;
            }
        }
    }
}

TEST(Borders, EmptyGridIsOneCell) {
    const SurfaceBorders::Grid grid = indexBorders(SurfaceBorders{}, 1);
    EXPECT_EQ(grid.cells, glm::uvec3(1));
    EXPECT_EQ(grid.cellStart, (std::vector<unsigned>{0, 0}));
    EXPECT_TRUE(grid.items.empty());
    const SurfaceBorders empty = findBorders(Scene{});
    EXPECT_EQ(empty.patchCount, 0u);
    EXPECT_TRUE(empty.segments.empty());
}

TEST(Borders, TinyReachKeepsTheGridSmall) {
    const SurfaceBorders borders = findBorders(cornellBox());
    const SurfaceBorders::Grid grid = indexBorders(borders, 1e-5f);
    EXPECT_LE(grid.cellStart.size(), 2000001u);
    EXPECT_GT(grid.cellStart.size(), 500000u);
    EXPECT_LT(grid.items.size(), 100000u); // 36 segments of about 130 cells, a few deep
}

TEST(Borders, LargeMesh) {
    Scene scene;
    addSphereMesh(scene, {0, 0, 0.9}, 1, 450, 225);
    addPlane(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
    const auto start = std::chrono::steady_clock::now();
    const SurfaceBorders borders = findBorders(scene);
    const auto found = std::chrono::steady_clock::now();
    const SurfaceBorders::Grid grid = indexBorders(borders, 0.02f);
    const auto indexed = std::chrono::steady_clock::now();
    std::printf("%zu primitives, %zu segments: found in %.2f s, indexed in %.2f s (%zu items)\n",
                borders.patchOfPrimitive.size(), borders.segments.size(),
                std::chrono::duration<double>(found - start).count(),
                std::chrono::duration<double>(indexed - found).count(), grid.items.size());
    EXPECT_EQ(borders.patchCount, 2u);
    EXPECT_NEAR(totalLength(borders), 40 + 2 * pi * std::sqrt(1 - 0.81), 1e-3);
}

} // namespace
} // namespace quasilux
