// Rays and hits as kernels/micro/traversal.cl and Embree are given them.
#pragma once

#include "shared_types.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

struct MicroRay {
    glm::vec3 origin, direction;
    float tMin, tMax;
};

/// As kernels/bvh.clh writes it.
struct MicroHit {
    float t, u, v;
    unsigned slot, primitive;

    bool missed() const { return primitive == QL_NONE; }
    unsigned index() const { return primitive & PRIMITIVE_INDEX_MASK; }
};

constexpr unsigned packetSize = 8;

/// Eight rays as Embree and kernels/bvh_packet_box.clh (Ray8) take them, field by field; origin and direction axis by axis.
struct alignas(32) RayPacket {
    float origin[3][packetSize], direction[3][packetSize], tMin[packetSize], tMax[packetSize];
};

struct alignas(32) HitPacket {
    float t[packetSize], u[packetSize], v[packetSize];
    unsigned primitive[packetSize];
};

/// As kernels/bvh_packet.clh writes it.
struct alignas(32) DeviceHitPacket {
    float t[packetSize], u[packetSize], v[packetSize];
    unsigned slot[packetSize], primitive[packetSize];

    MicroHit hit(size_t ray) const { return {t[ray], u[ray], v[ray], slot[ray], primitive[ray]}; }
};

/// The number of rays must be a multiple of 8.
std::vector<RayPacket> packetsOf(const std::vector<MicroRay>& rays);

} // namespace quasilux
