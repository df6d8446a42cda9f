// What the contests of the traversal share.
#pragma once

#include "bench/micro/contest.h"
#include "bench/micro/micro_parts.h"
#include "bench/micro/ray_sets.h"
#include "device/program.h"

#include <cmath>

namespace quasilux {

/// A tree on a device, with both forms of the lane mask (kernels/bvh_lanes.clh).
struct DeviceTree {
    DeviceTree(Device& device, const Bvh& bvh)
        : nodes(device, bvh.nodes, "tree nodes"), blocks(device, bvh.blocks, "primitives"),
          fast(device, "micro/traversal.cl", bvhOptions(bvh)),
          portable(device, "micro/traversal.cl", bvhOptions(bvh) + " -DPORTABLE_MASK") {}

    Buffer<shared::BvhNode> nodes;
    Buffer<shared::PrimitiveBlock> blocks;
    Program fast, portable;
};

struct RaySet {
    std::string name;
    const std::vector<MicroRay>& rays;
    bool coherent, occlusion;
};

constexpr float sameDistance = 1e-4f; ///< relative

inline bool differ(const MicroHit& ours, const MicroHit& theirs) {
    if (ours.missed() || theirs.missed()) return ours.missed() != theirs.missed();
    return !(std::abs(ours.t - theirs.t) <= sameDistance * theirs.t);
}
inline bool differ(unsigned ours, unsigned theirs) { return ours != theirs; }

/// Packets of sixteen rays (kernels/micro/bvh_packet.clh) against single rays and against Embree's packets; what is
/// compared are the hits of packets and single rays.
MicroRow packetRow(Device& device, unsigned threads, DeviceTree& tree, const EmbreeScene& embree, const RaySet& set,
                   unsigned rounds, const std::string& scene);

} // namespace quasilux
