// Packets of sixteen rays (kernels/micro/bvh_packet.clh) against single rays, with wrong kernels as control.
#include "support/meshes.h"
#include "support/traversal_device.h"

#include <cmath>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

/// Triangles (slivers, duplicates), spheres and null primitives.
std::vector<BvhPrimitive> everyKind() {
    std::vector<BvhPrimitive> primitives = awkwardPrimitives(2000, 31);
    for (const BvhPrimitive& sphere : randomSpheres(300, 32)) primitives.push_back(sphere);
    for (size_t i = 0; i < primitives.size(); i += 3) primitives[i].isNull = true;
    return primitives;
}

/// Packets of rays alike but for small differences, packets of unlike rays, and packets of rays along the axes, of
/// which the first five have one axis and the next five another, up and down.
Rays raysForPackets() {
    Rays rays = randomRays(60000, 33, 1.2f);
    const Rays noise = randomRays(rays.size(), 34, 0.1f);
    const size_t alike = rays.size() / 3, unlike = 2 * alike;
    for (size_t i = 0; i < alike; ++i) {
        rays[i].origin = rays[i / packetSize * packetSize].origin + noise[i].origin;
        rays[i].direction = rays[i / packetSize * packetSize].direction + 0.02f * noise[i].direction;
    }
    for (size_t i = unlike; i < rays.size(); ++i) {
        glm::vec3 direction(0.0f);
        direction[int(i % packetSize / 5 % 3)] = i % 2 == 0 ? 1.0f : -1.0f;
        rays[i].direction = direction;
    }
    return rays;
}

struct PacketFaults {
    size_t distances = 0, coordinates = 0, occlusion = 0, hits = 0;
};

PacketFaults packetFaults(TraversalDevice& scene, TraversalDevice& single) {
    const Rays rays = raysForPackets();
    const std::vector<TestHit> ours = scene.closestOfPackets(rays), expected = single.closest(rays);
    const std::vector<unsigned> blocked = scene.occludedOfPackets(rays), expectedBlocked = single.occluded(rays);
    PacketFaults faults;
    for (size_t i = 0; i < rays.size(); ++i) {
        faults.hits += expected[i].missed() ? 0 : 1;
        faults.distances += ours[i].missed() != expected[i].missed() || ours[i].t != expected[i].t ? 1 : 0;
        faults.occlusion += blocked[i] != expectedBlocked[i] ? 1 : 0;
        if (ours[i].primitive != expected[i].primitive) continue; // another at the same distance
        const bool same = std::abs(ours[i].u - expected[i].u) < 1e-3f && std::abs(ours[i].v - expected[i].v) < 1e-3f;
        faults.coordinates += same ? 0 : 1;
    }
    return faults;
}

const std::string everyFeature = "-DHAS_SPHERES -DHAS_NULL_PRIMITIVES";

TEST(Packets, AnswerAsSingleRays) {
    for (const char* mask : {"", " -DPORTABLE_MASK"}) {
        TraversalDevice scene(everyKind(), everyFeature + mask);
        const PacketFaults faults = packetFaults(scene, scene);
        EXPECT_EQ(faults.distances, 0u);
        EXPECT_EQ(faults.coordinates, 0u);
        EXPECT_EQ(faults.occlusion, 0u);
        EXPECT_GT(faults.hits, 10000u);
    }
}

/// What a wrong kernel says, and in place of what.
struct Control {
    const char *file, *from, *to;
};

/// Control of the test above.
TEST(PacketsControl, WrongKernelsWouldDiffer) {
    const std::vector<BvhPrimitive> primitives = everyKind();
    TraversalDevice single(primitives, everyFeature);
    const Control controls[] = {
        {"micro/bvh_packet_box.clh", "down ? lower : upper", "down ? upper : lower"},
        {"micro/bvh_packet_box.clh", "return anyOf16(enter <= leave)", "return !anyOf16(enter <= leave)"},
        {"micro/bvh_packet_block.clh", "smaller16(smaller16(u, v), w) >= 0.0f", "smaller16(u, v) >= 0.0f"},
        {"micro/bvh_packet.clh", "(kinds == kind)", "(kinds != QL_NONE)"},
    };
    for (const Control& control : controls) {
        TraversalDevice wrong(primitives, everyFeature, mutant(control.file, control.from, control.to));
        const PacketFaults faults = packetFaults(wrong, single);
        EXPECT_GT(faults.distances, 0u) << control.to;
        EXPECT_GT(faults.occlusion, 0u) << control.to;
    }
    TraversalDevice uAsV(primitives, everyFeature, mutant("micro/bvh_packet_block.clh", "clamp(second", "clamp(first"));
    EXPECT_GT(packetFaults(uAsV, single).coordinates, 0u);
    const Control occlusionControls[] = {
        {"micro/bvh_packet.clh", "&shear, 1, &t", "&shear, 0, &t"},                         // nulls met
        {"micro/bvh_packet.clh", "ray = rayOf(rays, lane)", "ray = rayOf(rays, lane ^ 1)"}, // few rays
        {"micro/bvh_packet_box.clh", "downY ? upperY : lowerY", "downY ? lowerY : upperY"}, // mixed signs
    };
    for (const Control& control : occlusionControls) {
        TraversalDevice wrong(primitives, everyFeature, mutant(control.file, control.from, control.to));
        EXPECT_GT(packetFaults(wrong, single).occlusion, 0u) << control.to;
    }
}

} // namespace
} // namespace quasilux
