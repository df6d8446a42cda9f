// Media that vary in space on the device (kernels/volume_grid.clh) against the same in double: values at points for
// every filter and wrap, turned boxes too; optical depth of rays against a fine midpoint rule; free flights against the
// distribution that the depth gives. 4 chi-squared tests; false-alarm rate of the program 1e-4 (support/chi_squared.h).
#include "prepare/scene_tables.h"
#include "prepare/volume_tables.h"
#include "scene/volumes/volume_plugin.h"
#include "support/chi_squared.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace quasilux {
namespace {

using glm::dvec3;

constexpr size_t sampleCount = 200000;
constexpr int statisticalTests = 4;
constexpr float scale = 2.5f;

struct Cloud {
    const char* name;
    unsigned filter, wrap;
    glm::dmat4 toWorld;
    VolumeDescription volume{};

    int index(int i, int n) const {
        if (wrap == WRAP_CLAMP) return std::clamp(i, 0, n - 1);
        const int period = wrap == WRAP_MIRROR ? 2 * n : n;
        const int k = ((i % period) + period) % period;
        return k < n ? k : 2 * n - 1 - k;
    }
    double voxel(int x, int y, int z, unsigned channel) const {
        const auto& size = volume.device.size;
        const size_t row = size_t(index(z, int(size[2]))) * size[1] + size_t(index(y, int(size[1])));
        const size_t at = row * size[0] + size_t(index(x, int(size[0])));
        return double(volume.values[at * volume.device.channels + channel]);
    }
    /// Whatever the box.
    double value(const dvec3& p, unsigned channel = 0) const {
        const auto& size = volume.device.size;
        dvec3 place = dvec3(glm::inverse(toWorld) * glm::dvec4(p, 1)) * dvec3(size[0], size[1], size[2]);
        if (filter == VOLUME_TRILINEAR) place -= 0.5;
        const glm::dvec3 low = glm::floor(place), f = place - low;
        const glm::ivec3 c(low);
        if (filter == VOLUME_NEAREST) return voxel(c.x, c.y, c.z, channel);
        double sum = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
            sum += (dx ? f.x : 1 - f.x) * (dy ? f.y : 1 - f.y) * (dz ? f.z : 1 - f.z) *
                   voxel(c.x + dx, c.y + dy, c.z + dz, channel);
        }
        return sum;
    }
    double density(const dvec3& p) const {
        const auto &low = volume.device.lower, &high = volume.device.upper;
        const bool inside = p.x >= double(low.x) && p.y >= double(low.y) && p.z >= double(low.z) &&
                            p.x <= double(high.x) && p.y <= double(high.y) && p.z <= double(high.z);
        return inside ? double(scale) * value(p) : 0;
    }
};

VolumeDescription makeVolume(const Cloud& cloud, unsigned channels, uint64_t seed) {
    VolumeDescription volume;
    volume.device.size[0] = 13;
    volume.device.size[1] = 9;
    volume.device.size[2] = 17;
    volume.device.channels = channels;
    volume.device.filter = cloud.filter;
    volume.device.wrap = cloud.wrap;
    volume.values = uniformNumbers(size_t(13 * 9 * 17) * channels, seed);
    for (size_t i = 0; i < volume.values.size(); ++i)
        if (i % 5 == 0 || (i / channels % 13 > 4 && i / channels / 117 < 9))
            volume.values[i] = 0; // holes, empty blocks
    placeVolume(volume, cloud.toWorld, {});
    return volume;
}

std::vector<Cloud> clouds(unsigned channels = 1) {
    const glm::dmat4 unit(1.0);
    const glm::dmat4 placed = glm::scale(glm::translate(unit, dvec3(-1, 0.5, 2)), dvec3(2, 1, 3));
    const glm::dmat4 turned = glm::scale(glm::rotate(placed, 0.6, glm::normalize(dvec3(1, 2, 1))), dvec3(1, 2, 0.5));
    std::vector<Cloud> all{{"trilinear, clamped", VOLUME_TRILINEAR, WRAP_CLAMP, placed},
                           {"trilinear, repeated, turned", VOLUME_TRILINEAR, WRAP_REPEAT, turned},
                           {"trilinear, mirrored, turned", VOLUME_TRILINEAR, WRAP_MIRROR, turned},
                           {"nearest, clamped, turned", VOLUME_NEAREST, WRAP_CLAMP, turned}};
    for (Cloud& cloud : all) cloud.volume = makeVolume(cloud, channels, 7);
    return all;
}

/// The medium's records and what they refer to, as kernels read them.
std::vector<uint32_t> words(const VolumeDescription& extinction, const VolumeDescription* albedo = nullptr) {
    MediumTables tables;
    appendVolume(extinction, tables);
    if (albedo) appendVolume(*albedo, tables);
    shared::Medium medium{};
    medium.extinctionGrid = 1;
    medium.albedoGrid = albedo ? 2 : 0;
    medium.albedo = {0.1f, 0.2f, 0.3f};
    medium.extinctionScale = scale;
    tables.media = {medium};
    SceneTableWriter writer;
    appendMedia(tables, writer);
    return writer.words();
}

Program& program() {
    static Program all = testProgram("heterogeneous.cl", "-DHAS_HETEROGENEOUS_MEDIA");
    return all;
}

struct TestRay {
    dvec3 origin, direction;
    double length;
};

/// From about the box in all directions, along the axes too, some short, some endless.
std::vector<TestRay> testRays(const Cloud& cloud) {
    const auto& d = cloud.volume.device;
    const dvec3 low(d.lower.x, d.lower.y, d.lower.z), high(d.upper.x, d.upper.y, d.upper.z);
    const auto u = uniformNumbers(7 * 300, 11);
    std::vector<TestRay> rays;
    for (size_t i = 0; i < 300; ++i) {
        const float* n = &u[7 * i];
        const dvec3 from = low + (dvec3(n[0], n[1], n[2]) * 2.0 - 0.5) * (high - low);
        const dvec3 to = low + dvec3(n[3], n[4], n[5]) * (high - low);
        dvec3 direction = glm::normalize(to - from);
        if (i % 4 == 0) direction = dvec3(i % 3 == 0, i % 3 == 1, i % 3 == 2) * (i % 8 == 0 ? 1.0 : -1.0);
        rays.push_back({from, direction, i % 5 == 0 ? 1e30 : 6.0 * double(n[6])});
    }
    return rays;
}

std::vector<float> packed(const std::vector<TestRay>& rays) {
    std::vector<float> numbers;
    for (const TestRay& r : rays)
        for (const double x :
             {r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y, r.direction.z, r.length})
            numbers.push_back(static_cast<float>(x));
    return numbers;
}

std::vector<float> run(const char* kernel, const std::vector<uint32_t>& medium, const std::vector<float>& numbers,
                       size_t count, size_t resultSize) {
    Buffer<uint32_t> m(testDevice(), medium, "medium");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), resultSize, "result");
    program().kernel(kernel).launch(count, m, in, out, cl_uint(count));
    return out.read();
}

/// Depths at the ends of equal steps along a ray.
std::vector<double> depthsAlong(const Cloud& cloud, const TestRay& ray, double length, size_t steps) {
    std::vector<double> depths = {0};
    for (size_t i = 0; i < steps; ++i) {
        const dvec3 p = ray.origin + ray.direction * length * ((double(i) + 0.5) / double(steps));
        depths.push_back(depths.back() + cloud.density(p) * length / double(steps));
    }
    return depths;
}

TEST(Heterogeneous, ValuesAreThoseInDouble) {
    const auto colours = clouds(3);
    const auto densities = clouds();
    for (size_t k = 0; k < densities.size(); ++k) {
        const Cloud &cloud = densities[k], &colour = colours[k];
        const auto rays = testRays(cloud);
        std::vector<float> points;
        for (const TestRay& r : rays)
            for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(r.origin[axis]));
        const auto found = run("valuesAt", words(cloud.volume, &colour.volume), points, rays.size(), 4 * rays.size());
        for (size_t i = 0; i < rays.size(); ++i) {
            const dvec3 p(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
            EXPECT_NEAR(found[4 * i], cloud.density(p), 3e-5) << cloud.name << ' ' << i;
            for (unsigned c = 0; c < 3; ++c)
                EXPECT_NEAR(found[4 * i + 1 + c], colour.value(p, c), 3e-5) << cloud.name << ' ' << i;
        }
    }
}

TEST(Heterogeneous, OpticalDepthIsTheIntegralOfTheDensity) {
    for (const Cloud& cloud : clouds()) {
        const auto rays = testRays(cloud);
        const auto found = run("opticalDepths", words(cloud.volume), packed(rays), rays.size(), rays.size());
        double largest = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const double exact = depthsAlong(cloud, rays[i], std::min(rays[i].length, 20.0), 20000).back();
            largest = std::max(largest, exact);
            // A step of the midpoint rule is up to 1e-3 long: it blurs the jumps between voxels.
            const double jumps = cloud.filter == VOLUME_NEAREST ? 2e-3 : 0;
            EXPECT_NEAR(found[i], exact, 2e-3 * std::max(exact, 0.5) + jumps) << cloud.name << ' ' << i;
        }
        EXPECT_GT(largest, 1) << "no ray met the cloud";
    }
}

/// p-value of the distances against `assumed` times the true depth.
double flightFit(const Cloud& cloud, double assumed) {
    const TestRay ray{dvec3(cloud.toWorld * glm::dvec4(-0.3, 0.2, 0.4, 1)),
                      glm::normalize(glm::dmat3(cloud.toWorld) * dvec3(1.2, 0.3, 0.25)), 4};
    constexpr size_t steps = 40000;
    constexpr int cells = 60;
    const auto depths = depthsAlong(cloud, ray, ray.length, steps);
    const auto distances = [&] {
        Buffer<uint32_t> m(testDevice(), words(cloud.volume), "medium");
        Buffer<float> r(testDevice(), packed({ray}), "ray"), u(testDevice(), uniformNumbers(sampleCount, 5), "numbers"),
            out(testDevice(), sampleCount, "distances");
        program().kernel("flightDistances").launch(sampleCount, m, r, u, out, cl_uint(sampleCount));
        return out.read();
    }();
    const double all = -std::expm1(-assumed * depths.back());
    std::vector<uint64_t> counts(cells + 1);
    std::vector<double> probabilities;
    std::vector<double> ends; // of cells of equal length
    for (int k = 0; k < cells; ++k) {
        const double before = depths[size_t(k) * steps / cells], after = depths[size_t(k + 1) * steps / cells];
        probabilities.push_back(std::exp(-assumed * before) - std::exp(-assumed * after));
    }
    for (const float t : distances)
        ++counts[t < float(ray.length) ? std::min(size_t(double(t) / ray.length * cells), size_t(cells - 1))
                                       : size_t(cells)];
    EXPECT_GT(all, 0.3) << cloud.name << ": too thin to tell anything";
    return chiSquaredPValue(counts, probabilities);
}

TEST(Heterogeneous, FlightsFollowTheDepth) {
    for (const Cloud& cloud : clouds())
        EXPECT_GT(flightFit(cloud, 1), significanceLevel(statisticalTests)) << cloud.name;
}

TEST(Heterogeneous, NegativeControlAnotherExtinctionFails) {
    for (const Cloud& cloud : clouds())
        EXPECT_LT(flightFit(cloud, 1.05), significanceLevel(statisticalTests)) << cloud.name;
}

TEST(Heterogeneous, WhatIsLeftOfANumberIsUniform) {
    const Cloud cloud = clouds().front();
    const TestRay ray{dvec3(cloud.toWorld * glm::dvec4(-0.3, 0.2, 0.4, 1)),
                      glm::normalize(glm::dmat3(cloud.toWorld) * dvec3(1.2, 0.3, 0.25)), 1.5};
    std::vector<float> u;
    for (int i = 0; i < 1000; ++i) u.push_back((float(i) + 0.5f) / 1000);
    Buffer<uint32_t> m(testDevice(), words(cloud.volume), "medium");
    Buffer<float> r(testDevice(), packed({ray}), "ray"), in(testDevice(), u, "numbers"),
        out(testDevice(), u.size(), "left");
    program().kernel("numbersLeft").launch(u.size(), m, r, in, out, cl_uint(u.size()));
    const double passes = std::exp(-depthsAlong(cloud, ray, ray.length, 20000).back());
    size_t left = 0;
    const auto found = out.read();
    for (size_t i = 0; i < u.size(); ++i) {
        if (found[i] < 0) continue;
        ++left;
        EXPECT_NEAR(found[i], (double(u[i]) - (1 - passes)) / passes, 1e-3);
    }
    EXPECT_NEAR(double(left) / 1000, passes, 2e-3);
}

} // namespace
} // namespace quasilux
