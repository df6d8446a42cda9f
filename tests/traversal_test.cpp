// Closest hit and occlusion of kernels/bvh.clh against Embree and against double precision, with wrong kernels as
// control.
#include "support/meshes.h"
#include "support/traversal_device.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <random>

namespace quasilux {
namespace {

using Primitives = std::vector<BvhPrimitive>;

constexpr float infinity = std::numeric_limits<float>::infinity();
const std::string allFeatures = " -DHAS_SPHERES -DHAS_NULL_PRIMITIVES";

void expectAsEmbree(const Primitives& primitives, TraversalDevice& scene, const Rays& rays, double undecidedShare) {
    const EmbreeOracle embree(primitives);
    const RayComparison closest = compareClosest(primitives, embree, rays, scene.closest(rays));
    const RayComparison occlusion = compareOcclusion(primitives, embree, rays, scene.occluded(rays));
    for (const RayComparison& comparison : {closest, occlusion}) {
        std::cout << "  " << comparison << "\n";
        EXPECT_EQ(comparison.mismatches, 0u) << comparison.firstMismatch;
        EXPECT_LE(double(comparison.undecided + comparison.embreeFaults), undecidedShare * double(rays.size()));
        EXPECT_GT(comparison.hits, rays.size() / 20);
    }
}

size_t faults(const Primitives& primitives, const Rays& rays, const std::vector<TestHit>& answers,
              bool passNull = false) {
    size_t count = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        const std::string fault = faultOfClosest(primitives, rays[i], answers[i], passNull);
        if (!fault.empty() && count++ == 0) std::cout << "  first fault: " << fault << "\n";
    }
    return count;
}

size_t occlusionFaults(const Primitives& primitives, const Rays& rays, const std::vector<unsigned>& answers) {
    size_t count = 0;
    for (size_t i = 0; i < rays.size(); ++i)
        count += faultOfOcclusion(primitives, rays[i], answers[i] != 0).empty() ? 0 : 1;
    return count;
}

TEST(Traversal, CornellBoxAsEmbree) {
    const Primitives primitives = cornellBoxPrimitives();
    TraversalDevice scene(primitives);
    expectAsEmbree(primitives, scene, randomRays(1000000, 1, 1.2f), 1e-3);
}

TEST(Traversal, LargeMeshAsEmbree) {
    const Primitives primitives = bumpySpherePrimitives(224, 224);
    ASSERT_GT(primitives.size(), 99000u);
    TraversalDevice scene(primitives);
    expectAsEmbree(primitives, scene, randomRays(1000000, 2, 1.2f), 1e-3);
}

TEST(Traversal, DegenerateSliverAndDuplicateTrianglesAsEmbree) {
    const Primitives primitives = awkwardPrimitives(5000, 3);
    TraversalDevice scene(primitives);
    expectAsEmbree(primitives, scene, randomRays(1000000, 3, 1.2f), 1e-2);
}

TEST(Traversal, PortableMaskGivesTheSameAnswers) {
    const Primitives primitives = bumpySpherePrimitives(60, 60);
    TraversalDevice fast(primitives), portable(primitives, "-DPORTABLE_MASK");
    const Rays rays = randomRays(100000, 4, 1.2f);
    EXPECT_EQ(fast.occluded(rays), portable.occluded(rays));
    const std::vector<TestHit> a = fast.closest(rays), b = portable.closest(rays);
    for (size_t i = 0; i < rays.size(); ++i) ASSERT_TRUE(a[i].slot == b[i].slot && a[i].t == b[i].t) << i;
}

TEST(Traversal, AxisParallelRaysAsEmbree) {
    const Primitives primitives = cornellBoxPrimitives();
    TraversalDevice scene(primitives);
    // Many of them run in the plane of a wall or along an edge, where both answers are right.
    expectAsEmbree(primitives, scene, axisParallelRays(), 0.2);
}

TEST(Traversal, RaysFromSurfacesAsEmbree) {
    for (const Primitives& primitives : {cornellBoxPrimitives(), bumpySpherePrimitives(60, 60)}) {
        TraversalDevice scene(primitives);
        const Rays before = randomRays(30000, 5, 0.9f);
        // The surface that a ray begins on may or may not be met at t = 0 within rounding.
        expectAsEmbree(primitives, scene, surfaceRays(before, scene.closest(before), 6), 0.8);
    }
}

TEST(Traversal, EmptySceneIsNeverMet) {
    TraversalDevice scene({});
    EXPECT_EQ(scene.bvh().nodes.size(), 1u);
    const Rays rays = axisParallelRays();
    for (const TestHit& hit : scene.closest(rays)) ASSERT_TRUE(hit.missed() && hit.slot == QL_NONE);
    for (unsigned blocked : scene.occluded(rays)) ASSERT_EQ(blocked, 0u);
}

TEST(Traversal, RaysThatAreNotNumbersEndAsMisses) {
    TraversalDevice scene(bumpySpherePrimitives(60, 60));
    const Rays good = randomRays(300, 18, 1.2f);
    Rays rays;
    for (TestRay ray : good) {
        const size_t component = rays.size() % 7;
        for (const float bad : {std::nanf(""), infinity, -infinity}) {
            rays.push_back(ray);
            if (component < 3)
                rays.back().origin[int(component)] = bad;
            else if (component < 6)
                rays.back().direction[int(component) - 3] = bad;
            else
                rays.back().direction = glm::vec3(bad);
        }
    }
    for (const TestHit& hit : scene.closest(rays)) ASSERT_TRUE(hit.missed());
    for (unsigned blocked : scene.occluded(rays)) ASSERT_EQ(blocked, 0u);
}

TEST(Traversal, OneTriangle) {
    BvhPrimitive triangle;
    triangle.v0 = {0, 0, -2}, triangle.v1 = {4, 0, -2}, triangle.v2 = {0, 2, -2};
    TraversalDevice scene({triangle});
    const TestHit hit = scene.closest({{{1, 0.5f, 0}, {0, 0, -0.5f}, 0, infinity}})[0];
    EXPECT_FLOAT_EQ(hit.t, 4);
    EXPECT_FLOAT_EQ(hit.u, 0.25f);
    EXPECT_FLOAT_EQ(hit.v, 0.25f);
    EXPECT_EQ(hit.primitive, 0u);
    // The far end belongs to the ray, the near one does not.
    const Rays ends = {
        {{1, 0.5f, 0}, {0, 0, -1}, 0, 2}, {{1, 0.5f, 0}, {0, 0, -1}, 2, 9}, {{3, 1, 0}, {0, 0, -1}, 0, 9}};
    EXPECT_EQ(scene.occluded(ends), (std::vector<unsigned>{1, 0, 0}));
}

TEST(Traversal, Spheres) {
    const Primitives primitives = randomSpheres(300, 7);
    TraversalDevice scene(primitives, allFeatures);
    Rays rays = randomRays(20000, 8, 1.2f);
    EXPECT_EQ(faults(primitives, rays, scene.closest(rays)), 0u);
    EXPECT_EQ(occlusionFaults(primitives, rays, scene.occluded(rays)), 0u);
    rays = surfaceRays(rays, scene.closest(rays), 9);
    EXPECT_GT(rays.size(), 5000u);
    EXPECT_EQ(faults(primitives, rays, scene.closest(rays)), 0u);
}

TEST(Traversal, SmallSphereFarAway) {
    BvhPrimitive sphere;
    sphere.isSphere = true;
    sphere.v0 = {1000, 0, 0}, sphere.v1.x = 0.1f;
    TraversalDevice scene({sphere}, allFeatures);
    std::mt19937 engine(10);
    std::uniform_real_distribution<float> across(-0.2f, 0.2f);
    Rays rays(20000);
    for (TestRay& ray : rays) {
        const float y = across(engine), z = across(engine);
        ray = {{0, 0, 0}, glm::normalize(glm::vec3(1000, y, z)), 0, infinity};
    }
    EXPECT_EQ(faults({sphere}, rays, scene.closest(rays)), 0u);
}

TEST(Traversal, NullPrimitivesArePassed) {
    Primitives primitives = awkwardPrimitives(300, 11);
    for (const BvhPrimitive& sphere : randomSpheres(60, 12)) primitives.push_back(sphere);
    for (size_t i = 0; i < primitives.size(); i += 3) primitives[i].isNull = true;
    TraversalDevice scene(primitives, allFeatures);
    const Rays rays = randomRays(20000, 13, 1.2f);
    const std::vector<TestHit> all = scene.closest(rays);
    EXPECT_EQ(faults(primitives, rays, all), 0u);
    EXPECT_EQ(faults(primitives, rays, scene.closestOpaque(rays), true), 0u);
    EXPECT_EQ(occlusionFaults(primitives, rays, scene.occluded(rays)), 0u);
    size_t nulls = 0;
    for (const TestHit& hit : all)
        if (!hit.missed()) {
            ASSERT_EQ((hit.primitive & PRIMITIVE_NULL_BIT) != 0, primitives[hit.index()].isNull);
            nulls += primitives[hit.index()].isNull ? 1 : 0;
        }
    EXPECT_GT(nulls, rays.size() / 20);
}

TEST(Traversal, FarFromTheOrigin) {
    const glm::vec3 offset(1e5f, -1e5f, 5e4f);
    const Primitives primitives = moved(bumpySpherePrimitives(40, 40), offset);
    const Rays rays = randomRays(5000, 14, 1.5f, offset);
    EXPECT_EQ(faults(primitives, rays, TraversalDevice(primitives).closest(rays)), 0u);
    // Control: without room for the rounding of o / d, boxes are missed.
    TraversalDevice wrong(primitives, "",
                          mutant("bvh_box.clh", "#define BOX_SHIFT_ERROR 2.4e-7f", "#define BOX_SHIFT_ERROR 0"));
    EXPECT_GT(faults(primitives, rays, wrong.closest(rays)), 0u);
}

TEST(TraversalControl, WrongKernelsAreFound) {
    const Primitives primitives = bumpySpherePrimitives(60, 60);
    const EmbreeOracle embree(primitives);
    const Rays rays = randomRays(20000, 15, 1.2f);
    struct Control {
        const char* file;
        const char* from;
        const char* to;
        bool breaksOcclusion; // any order of visits gives the same occlusion
    };
    const Control controls[] = {
        {"bvh_box.clh", "return laneMask(enter <= leave)", "return 127u & laneMask(enter <= leave)", true},
        {"bvh_block.clh", "smaller(smaller(u, v), w) >= 0.0f", "smaller(u, v) >= 0.0f", true},
        {"bvh.clh", ">> 32)) <= tMax)", ">> 32)) <= 0.8f * tMax)", false},
        {"bvh.clh", "max(a, b);\n        return", "min(a, b);\n        return", false},
        {"bvh.clh", "if (distance[lane] <= hit->t)", "if (distance[lane] >= 0)", false},
    };
    for (const Control& control : controls) {
        TraversalDevice scene(primitives, "", mutant(control.file, control.from, control.to));
        EXPECT_GT(compareClosest(primitives, embree, rays, scene.closest(rays)).mismatches, 0u) << control.to;
        if (!control.breaksOcclusion) continue;
        EXPECT_GT(compareOcclusion(primitives, embree, rays, scene.occluded(rays)).mismatches, 0u) << control.to;
    }
}

TEST(TraversalControl, WrongSphereAndNullKernelsAreFound) {
    Primitives primitives = randomSpheres(300, 7);
    for (size_t i = 0; i < primitives.size(); i += 3) primitives[i].isNull = true;
    const Rays rays = randomRays(20000, 8, 1.2f);
    TraversalDevice oneRoot(primitives, allFeatures, mutant("bvh_sphere.clh", "firstCounts ? first : second", "first"));
    EXPECT_GT(faults(primitives, rays, oneRoot.closest(rays)), 0u);
    TraversalDevice nullsMet(primitives, "-DHAS_SPHERES");
    EXPECT_GT(faults(primitives, rays, nullsMet.closestOpaque(rays), true), 0u);
    EXPECT_GT(occlusionFaults(primitives, rays, nullsMet.occluded(rays)), 0u);
}

TEST(TraversalControl, CoarseGuardOfZeroDirectionsIsFound) {
    const Primitives primitives = cornellBoxPrimitives();
    const EmbreeOracle embree(primitives);
    const Rays rays = axisParallelRays();
    TraversalDevice scene(primitives, "",
                          mutant("bvh_box.clh", "BOX_SMALLEST_DIRECTION 1e-18f", "BOX_SMALLEST_DIRECTION 0.1f"));
    EXPECT_GT(compareClosest(primitives, embree, rays, scene.closest(rays)).mismatches, 0u);
}

} // namespace
} // namespace quasilux
