// No ray slips between triangles that share an edge or a vertex, and no ray meets the surface again that it leaves.
// QUASILUX_WATERTIGHT_RAYS sets the number of rays by mesh and place.
#include "support/meshes.h"
#include "support/placed_scenes.h"
#include "support/traversal_device.h"

#include "render/method.h"

#include "render/geometry_buffers.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

using Primitives = std::vector<BvhPrimitive>;

size_t rayCount() {
    const char* text = std::getenv("QUASILUX_WATERTIGHT_RAYS");
    return text ? std::stoull(text) : 100'000;
}

/// Faces of a cube in [-1, 1]^3, each of n x n cells of two triangles, whose vertices are the same bits wherever they
/// occur; `spread` moves them within their face, so that cells are of all shapes, down to slivers.
Primitives cubeSurface(unsigned n, double spread, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> uniform(-spread, spread);
    std::vector<double> line(n + 1);
    for (unsigned k = 0; k <= n; ++k) line[k] = 2.0 * k / n - 1 + (k == 0 || k == n ? 0 : uniform(engine) / n);
    Primitives triangles;
    const auto vertex = [&](int face, unsigned i, unsigned j) {
        glm::dvec3 p;
        p[face / 2] = face % 2 ? 1 : -1;
        p[(face / 2 + 1) % 3] = line[i];
        p[(face / 2 + 2) % 3] = line[j];
        // Out of the axes: by the same operations for the same vertex, so to the same bits.
        const glm::dvec3 turned(0.36 * p.x + 0.48 * p.y - 0.8 * p.z, -0.8 * p.x + 0.6 * p.y,
                                0.48 * p.x + 0.64 * p.y + 0.6 * p.z);
        return glm::vec3(turned);
    };
    for (int face = 0; face < 6; ++face)
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) {
                const glm::vec3 a = vertex(face, i, j), b = vertex(face, i + 1, j), c = vertex(face, i + 1, j + 1),
                                d = vertex(face, i, j + 1);
                triangles.push_back({a, b, c, false, false});
                triangles.push_back({a, c, d, false, false});
            }
    return triangles;
}

Primitives scaled(Primitives primitives, float scale) {
    for (auto& p : primitives) p.v0 *= scale, p.v1 *= scale, p.v2 *= scale;
    return primitives;
}

/// Rays from around the middle towards vertices and points on edges.
Rays raysAtEdges(const Primitives& primitives, size_t count, float extent, unsigned seed) {
    std::mt19937 engine(seed);
    std::uniform_int_distribution<size_t> anyOf(0, primitives.size() - 1);
    std::uniform_real_distribution<float> uniform(0, 1), around(-extent, extent);
    Rays rays(count);
    for (size_t k = 0; k < count; ++k) {
        const BvhPrimitive& p = primitives[anyOf(engine)];
        const glm::vec3 corners[] = {p.v0, p.v1, p.v2};
        const size_t edge = k % 3;
        const float along = k % 4 == 0 ? 0 : uniform(engine);
        const glm::vec3 target = glm::mix(corners[edge], corners[(edge + 1) % 3], along);
        const glm::vec3 origin = k % 5 == 0 ? glm::vec3(0) : glm::vec3(around(engine), around(engine), around(engine));
        rays[k] = {origin, glm::normalize(target - origin), 0, std::numeric_limits<float>::infinity()};
    }
    return rays;
}

struct Escaped {
    size_t closest = 0, occlusion = 0;
};
Escaped countEscaped(const Primitives& mesh, float extent, const KernelSources& replaced = {}) {
    TraversalDevice device(mesh, "", replaced);
    Escaped escaped;
    constexpr size_t batch = 1'000'000;
    for (size_t done = 0; done < rayCount(); done += batch) {
        const Rays rays = raysAtEdges(mesh, std::min(batch, rayCount() - done), extent, unsigned(done / batch));
        for (const TestHit& hit : device.closest(rays)) escaped.closest += hit.missed();
        for (const unsigned met : device.occluded(rays)) escaped.occlusion += met == 0;
    }
    return escaped;
}

TEST(Watertight, NoRayEscapes) {
    for (const auto& [cells, spread] : {std::pair{1u, 0.0}, std::pair{16u, 0.999}, std::pair{40u, 0.9}})
        for (const float scale : {1.f, 1e-4f, 1e5f}) {
            const auto escaped = countEscaped(scaled(cubeSurface(cells, spread, cells), scale), 0.4f * scale);
            EXPECT_EQ(escaped.closest, 0u) << cells << " cells, scale " << scale;
            EXPECT_EQ(escaped.occlusion, 0u) << cells << " cells, scale " << scale;
        }
}

// Far from the origin vertices are rounded to a coarse grid, but still the same for all triangles.
TEST(Watertight, NoRayEscapesFarAway) {
    Primitives mesh = cubeSurface(8, 0.9, 3);
    const glm::vec3 offset(1e4f, -2e4f, 5e3f);
    for (auto& p : mesh) p.v0 += offset, p.v1 += offset, p.v2 += offset;
    TraversalDevice device(mesh);
    Rays rays = raysAtEdges(cubeSurface(8, 0.9, 3), rayCount() / 4, 0.4f, 1);
    for (TestRay& ray : rays) ray.origin += offset;
    size_t escaped = 0;
    for (const TestHit& hit : device.closest(rays)) escaped += hit.missed();
    EXPECT_EQ(escaped, 0u);
}

// Control: edge functions that are rounded differently for the two triangles of an edge.
TEST(WatertightControl, UnevenRoundingIsFound) {
    const auto wrong = mutant("bvh_block.clh", "return fma(a, b, -cd) + fma(-c, d, cd);", "return fma(a, b, -cd);");
    EXPECT_GT(countEscaped(cubeSurface(16, 0.999, 16), 0.4f, wrong).closest, 0u);
}

// ---- rays that leave surfaces ------------------------------------------------------------------------------------

struct Returned {
    size_t rays = 0, hits = 0;
};
Returned countReturned(const Scene& scene, float extent, const KernelSources& replaced = {}) {
    const DeviceScene flat = flattenScene(scene);
    const GeometryBuffers geometry(testDevice(), flat);
    Program program = mutantProgram("leaving.cl", kernelOptions(flat, RenderSettings{}), replaced);
    const Rays rays = randomRays(20'000, 5, extent);
    const Buffer<TestRay> in(testDevice(), rays, "rays");
    const Buffer<unsigned> out(testDevice(), rays.size(), "returned");
    program.kernel("leaveSurfaces")
        .launch(rays.size(), geometry.nodes, geometry.blocks, geometry.tables, flat.offsets, in, out,
                cl_uint(rays.size()));
    Returned returned;
    for (const unsigned met : out.read()) {
        if (met == QL_NONE) continue;
        ++returned.rays;
        returned.hits += met;
    }
    return returned;
}

const char* const plainBall = R"(<bsdf type="diffuse"/>)";

TEST(LeavingRays, DoNotMeetTheirSurface) {
    for (const Placement place : {Placement{}, Placement{"Turned", 1, "0,0,0", true}, Placement{"Tiny", 1e-4},
                                  Placement{"Huge", 1e5, "0,0,0", true}}) {
        const auto returned = countReturned(placedScene(roomText(plainBall), place), float(0.9 * place.scale));
        EXPECT_GT(returned.rays, 5000u) << place.name;
        EXPECT_EQ(returned.hits, 0u) << place.name;
    }
}

// Triangles of all shapes, slivers among them, as faces of their own.
TEST(LeavingRays, DoNotMeetTheirSliver) {
    Scene scene = placedScene(roomText(plainBall), Placement{});
    Mesh& mesh = scene.shapes[0].mesh;
    mesh = {};
    for (const BvhPrimitive& p : awkwardPrimitives(3000, 4)) {
        const auto first = unsigned(mesh.positions.size());
        for (const glm::vec3& corner : {p.v0, p.v1, p.v2}) mesh.positions.push_back(corner);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    const auto returned = countReturned(scene, 0.9f);
    EXPECT_GT(returned.rays, 5000u);
    EXPECT_EQ(returned.hits, 0u);
}

TEST(LeavingRaysControl, ATooSmallStepIsFound) {
    const auto wrong = mutant("math.clh", "#define POSITION_ERROR 0x1p-21f", "#define POSITION_ERROR 0x1p-26f");
    EXPECT_GT(countReturned(placedScene(roomText(plainBall), {"Turned", 1, "0,0,0", true}), 0.9f, wrong).hits, 0u);
}

} // namespace
} // namespace quasilux
