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

/// Eight rays, field by field; origin and direction axis by axis.
struct alignas(32) RayPacket {
    float origin[3][packetSize], direction[3][packetSize], tMin[packetSize], tMax[packetSize];
};

struct alignas(32) HitPacket {
    float t[packetSize], u[packetSize], v[packetSize];
    unsigned primitive[packetSize];
};

/// The number of rays must be a multiple of 8.
std::vector<RayPacket> packetsOf(const std::vector<MicroRay>& rays);

} // namespace quasilux
