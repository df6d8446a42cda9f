/* Rays against scenes of two levels: what they meet, and whether rays that leave it meet it again. */
#include "micro/ray_buffer.clh"
#include "rng.clh"
#include "sampling.clh"
#include "surface.clh"

#define DIRECTIONS 8

/* As tests/instance_levels_test.cpp has it. */
typedef struct {
    float t;
    uint primitive; /* QL_NONE: nothing */
    uint instance;  /* its number, QL_NONE: none */
    uint patch;
    Packed3 position, normal;
    uint isOccluded;
    uint returned; /* of DIRECTIONS rays that leave, those that meet the same primitive again */
} InstanceHit;

inline Packed3 pack(float3 v) {
    Packed3 p = {v.x, v.y, v.z};
    return p;
}

__kernel void meetInstances(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                            __global const uint* tables, const SceneTables scene, __global const float* rays,
                            __global InstanceHit* hits, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    const Ray ray = loadRay(rays, i);
    const Hit hit = intersectClosest(nodes, blocks, &ray);
    hits[i].t = hit.t;
    hits[i].primitive = hit.primitive == QL_NONE ? QL_NONE : hit.primitive & PRIMITIVE_INDEX_MASK;
    hits[i].instance = hit.instance == QL_NONE
                           ? QL_NONE
                           : (hit.instance - scene.instances) * INSTANCE_STEP * 4 / (uint)sizeof(Instance);
    hits[i].isOccluded = occluded(nodes, blocks, &ray);
    hits[i].returned = 0;
    if (hit.primitive == QL_NONE) return;
    const Surface s = surfaceAt(&hit, ray.origin, ray.direction, blocks, tables, &scene);
    hits[i].patch = s.patch;
    hits[i].position = pack(s.position);
    hits[i].normal = pack(s.geometricNormal);
    Rng rng = rngMake(1, 2, 3, (uint)i);
    for (uint k = 0; k < DIRECTIONS; ++k) {
        const Ray leaving = leavingRay(&s, sampleUniformSphere(rngNext2(&rng)));
        const Hit next = intersectClosest(nodes, blocks, &leaving);
        hits[i].returned += next.slot == hit.slot && next.instance == hit.instance;
    }
}
