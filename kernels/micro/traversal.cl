/* Rays of a buffer (ray_buffer.clh) through kernels/bvh.clh, and of a
 * buffer of packets (Ray16) through kernels/micro/bvh_packet.clh. */
#include "micro/bvh_packet.clh"
#include "micro/ray_buffer.clh"

__kernel void closestHits(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                          __global const float* rays, __global Hit* hits, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Ray ray = loadRay(rays, i);
    hits[i] = intersectClosest(nodes, blocks, &ray);
}

__kernel void closestOpaqueHits(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                                __global const float* rays, __global Hit* hits, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Ray ray = loadRay(rays, i);
    hits[i] = intersectClosestOpaque(nodes, blocks, &ray);
}

__kernel void occlusion(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                        __global const float* rays, __global uint* isOccluded, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Ray ray = loadRay(rays, i);
    isOccluded[i] = occluded(nodes, blocks, &ray);
}

__kernel void closestHits16(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                            __global const Ray16* packets, __global Hit16* hits, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Ray16 rays = packets[i];
    Hit16 hit;
    intersectClosest16(nodes, blocks, &rays, &hit);
    hits[i] = hit;
}

__kernel void occlusion16(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                          __global const Ray16* packets, __global uint* isOccluded, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Ray16 rays = packets[i];
    vstore16(as_uint16(occluded16(nodes, blocks, &rays)) & 1u, i, isOccluded);
}
