// Rays and hits as kernels/micro/traversal.cl and Embree are given them.
#pragma once

#include "shared_types.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <stdexcept>
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

constexpr unsigned packetSize = 16; ///< of kernels/micro/bvh_packet.clh

/// Rays as Embree (8 or 16) and kernels/micro/bvh_packet_box.clh (Ray16) take them, field by field; origin and
/// direction axis by axis.
template <unsigned size>
struct alignas(4 * size) RayPacket {
    float origin[3][size], direction[3][size], tMin[size], tMax[size];
};

template <unsigned size>
struct alignas(4 * size) HitPacket {
    float t[size], u[size], v[size];
    unsigned primitive[size];
};

/// As kernels/micro/bvh_packet.clh writes it.
struct alignas(4 * packetSize) DeviceHitPacket {
    float t[packetSize], u[packetSize], v[packetSize];
    unsigned slot[packetSize], primitive[packetSize];

    MicroHit hit(size_t ray) const { return {t[ray], u[ray], v[ray], slot[ray], primitive[ray]}; }
};

/// The number of rays must be a multiple of `size`, 8 or 16.
template <unsigned size>
std::vector<RayPacket<size>> packetsOf(const std::vector<MicroRay>& rays) {
    if (rays.size() % size != 0) throw std::invalid_argument("rays that do not fill packets");
    std::vector<RayPacket<size>> packets(rays.size() / size);
    for (size_t i = 0; i < size * packets.size(); ++i) {
        RayPacket<size>& packet = packets[i / size];
        const size_t lane = i % size;
        for (int axis = 0; axis < 3; ++axis) {
            packet.origin[axis][lane] = rays[i].origin[axis];
            packet.direction[axis][lane] = rays[i].direction[axis];
        }
        packet.tMin[lane] = rays[i].tMin;
        packet.tMax[lane] = rays[i].tMax;
    }
    return packets;
}

} // namespace quasilux
