/* Rays that leave surfaces: do they meet the primitive again that they leave? */
#include "micro/ray_buffer.clh"
#include "rng.clh"
#include "sampling.clh"
#include "surface.clh"

#define DIRECTIONS 16

/* returned[i]: of DIRECTIONS rays on either side of the first hit of ray i (ray_buffer.clh), those that meet
 * the same triangle again, or, from outside, the same sphere; none can. QL_NONE where ray i hits nothing. */
__kernel void leaveSurfaces(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                            __global const uint* tables, const SceneTables scene, __global const float* rays,
                            __global uint* returned, uint count) {
    const size_t i = get_global_id(0);
    if (i >= count) return;
    Ray ray = loadRay(rays, i);
    ray.tMin = 0;
    ray.tMax = INFINITY;
    const Hit hit = intersectClosest(nodes, blocks, &ray);
    returned[i] = QL_NONE;
    if (hit.primitive == QL_NONE) return;
    const Surface s = surfaceAt(&hit, ray.origin, ray.direction, blocks, tables, &scene);
    Rng rng = rngMake(1, 2, 3, (uint)i);
    uint met = 0;
    for (uint k = 0; k < DIRECTIONS; ++k) {
        const float3 direction = sampleUniformSphere(rngNext2(&rng));
        const int inwards = (dot(direction, s.geometricNormal) < 0) == s.front;
        if ((hit.primitive & PRIMITIVE_SPHERE_BIT) && inwards) continue;
        const Ray leaving = leavingRay(&s, direction);
        met += intersectClosest(nodes, blocks, &leaving).slot == hit.slot;
    }
    returned[i] = met;
}
