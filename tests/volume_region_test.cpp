// Balls of density estimates in media, cut at the boundary or where extinction varies: what they make of light that is
// the same everywhere or varies linearly, integrated over the medium on the host. Weights follow from 48 directions
// that are turned at random, so means over 256 regions are compared; the numbers are fixed, so the outcome is too.
// Controls: weights without slopes.
#include "prepare/device_scene.h"
#include "render/geometry_buffers.h"
#include "render/method.h"
#include "support/chi_squared.h"
#include "support/scene_files.h"
#include "support/test_kernels.h"
#include "support/vol_files.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using glm::dvec3;

constexpr float radius = 0.4f;
constexpr unsigned regionCount = 256;
constexpr double tolerance = 0.01; // of the errors of weights that follow from 48 directions, and of the midpoint rule

/// As tests/kernels/volume_region.cl has them.
struct RegionWeights {
    float a, b[3], squaredA, squaredB[3], inverseVolume;
};

struct Fog {
    const char* name;
    const char* shape;
    const char* medium;                      ///< what says its extinction
    std::function<double(dvec3)> extinction; ///< 0 outside
};
void PrintTo(const Fog& fog, std::ostream* stream) { *stream << fog.name; }

bool inCube(dvec3 p) { return std::abs(p.x) < 1 && std::abs(p.y) < 1 && std::abs(p.z) < 1; }

const char* const even = R"(type="homogeneous"><float name="sigma_t" value="2"/>)";
const char* const rising = R"(type="heterogeneous"><volume name="sigma_t" type="gridvolume">
    <string name="filename" value="rising.vol"/><boolean name="use_grid_bbox" value="true"/></volume>)";

Fog cube() {
    return {"cube", "cube", even, [](dvec3 p) { return inCube(p) ? 2.0 : 0.0; }};
}
/// Not a polyhedron: its boundary is found by rays.
Fog ball() {
    return {"ball", "sphere", even, [](dvec3 p) { return glm::length(p) < 1 ? 2.0 : 0.0; }};
}
/// From 1 at x = -1 to 3 at x = 1.
Fog risingCube() {
    return {"rising", "cube", rising, [](dvec3 p) { return inCube(p) ? 2 + p.x : 0.0; }};
}

// Two voxels whose centres lie at x = -1 and 1: a trilinear filter is linear between them.
std::string risingFile() { return test::volFile({2, 1, 1}, 1, {1, 3}, {-2, -2, -2, 2, 2, 2}); }

DeviceScene prepare(const Fog& fog) {
    test::SceneFiles files;
    files.write("rising.vol", risingFile());
    const Scene scene = loadScene(files.write("scene.xml", fmt::format(R"(<scene version="3.0.0">
        <sensor type="perspective"/><shape type="{}"><bsdf type="null"/>
        <medium name="interior" {}</medium></shape>
        <emitter type="constant"/></scene>)",
                                                                       fog.shape, fog.medium)));
    return flattenScene(scene);
}

std::vector<RegionWeights> regionsAt(const DeviceScene& flat, dvec3 p, const std::string& options) {
    const GeometryBuffers geometry(testDevice(), flat);
    const Program program =
        testProgram("volume_region.cl", kernelOptions(flat, RenderSettings{}) + " -DESTIMATE_BIAS=1 " + options);
    const Buffer<float> numbers(testDevice(), uniformNumbers(size_t(2) * regionCount, 5), "numbers");
    const Buffer<RegionWeights> regions(testDevice(), regionCount, "regions");
    const float scale = radius / flat.media.front().kernelRadius[LIGHT_DIFFUSE];
    EXPECT_EQ(flat.media.front().kernelHalfHeight[LIGHT_DIFFUSE], 0) << "a flat kernel";
    program.kernel("regionsAt")
        .launch(regionCount, geometry.nodes, geometry.blocks, geometry.tables, flat.offsets,
                cl_float4{{float(p.x), float(p.y), float(p.z), 0}}, scale, numbers, regions, cl_uint(regionCount));
    return regions.read();
}

/// What light of 1 everywhere comes to, and where its mean lies, in units of the radius; by the kernel and by its
/// square.
struct Response {
    double one = 0, oneOfSquare = 0;
    dvec3 place{0}, placeOfSquare{0};
};

/// `axes`: of kernel space.
Response responseOf(const Fog& fog, dvec3 p, const std::string& options = "") {
    const DeviceScene flat = prepare(fog);
    const auto regions = regionsAt(flat, p, options);
    const auto& axis = flat.media.front().kernelAxis;
    EXPECT_EQ(axis.z, 1) << "kernel space is turned";
    Response mean;
    constexpr int cells = 40; // of the midpoint rule along each axis: their sides lie on the faces of the cube
    for (int i = 0; i < cells * cells * cells; ++i) {
        const dvec3 x = (dvec3(i % cells, i / cells % cells, i / cells / cells) + 0.5) * (2.0 / cells) - 1.0;
        const double k = 1 - glm::dot(x, x);
        if (k <= 0) continue;
        const double collides = fog.extinction(p + double(radius) * x) * std::pow(2 * double(radius) / cells, 3);
        for (const RegionWeights& r : regions) {
            const double perRegion = collides * double(r.inverseVolume) / regionCount;
            const double weight = perRegion * k * (r.a + r.b[0] * x.x + r.b[1] * x.y + r.b[2] * x.z);
            const double squared =
                perRegion * k * k * (r.squaredA + r.squaredB[0] * x.x + r.squaredB[1] * x.y + r.squaredB[2] * x.z);
            mean.one += weight;
            mean.oneOfSquare += squared;
            mean.place += weight * x;
            mean.placeOfSquare += squared * x;
        }
    }
    return mean;
}

/// Where extinction varies, the kernel's integral is of kernel times extinction; else the caller divides by it.
double extinctionHeld(const Fog& fog) { return fog.medium == rising ? 1 : 2; }

class CutBall : public ::testing::TestWithParam<std::tuple<Fog, dvec3>> {};

TEST_P(CutBall, ReproducesLinearLight) {
    const auto& [fog, p] = GetParam();
    const Response found = responseOf(fog, p);
    EXPECT_NEAR(found.one / extinctionHeld(fog), 1, tolerance);
    EXPECT_NEAR(found.oneOfSquare / extinctionHeld(fog), 1, tolerance);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(found.place[axis] / extinctionHeld(fog), 0, tolerance) << axis;
        EXPECT_NEAR(found.placeOfSquare[axis] / extinctionHeld(fog), 0, tolerance) << axis;
    }
}

INSTANTIATE_TEST_SUITE_P(Everywhere, CutBall,
                         ::testing::Values(std::tuple{cube(), dvec3(0.1, 0, 0)}, // whole
                                           std::tuple{cube(), dvec3(0.9, 0, 0)}, std::tuple{cube(), dvec3(-0.98, 0, 0)},
                                           std::tuple{cube(), dvec3(0.1, 0.76, -0.7)}, // at an edge
                                           std::tuple{ball(), dvec3(0.1, 0.2, 0)},
                                           std::tuple{ball(), dvec3(0.5, 0.6, -0.4)},
                                           std::tuple{risingCube(), dvec3(0, 0, 0)},
                                           std::tuple{risingCube(), dvec3(-0.8, 0, 0.3)}));

// In a corner steeper weights would cost more noise than they save bias: a part of the slope is left.
TEST(CutBallInCorner, HasLessThanHalfTheSlope) {
    const dvec3 corner(0.98, 0.98, 0.98);
    const Response found = responseOf(cube(), corner), plain = responseOf(cube(), corner, "-DNO_BORDER_CORRECTION");
    EXPECT_NEAR(found.one / 2, 1, 0.03);
    EXPECT_LT(glm::length(found.place), 0.5 * glm::length(plain.place));
}

TEST(CutBallControl, WithoutSlopesTheMeanIsElsewhere) {
    for (const auto& [fog, p] : {std::pair{cube(), dvec3(0.9, 0, 0)}, std::pair{risingCube(), dvec3(0, 0, 0)}}) {
        const Response found = responseOf(fog, p, "-DNO_BORDER_CORRECTION");
        EXPECT_NEAR(found.one / extinctionHeld(fog), 1, tolerance) << fog.name;
        EXPECT_GT(std::abs(found.place.x), 2 * tolerance) << fog.name;
    }
}

} // namespace
} // namespace quasilux
