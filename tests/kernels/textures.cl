/* kernels/texture.clh over arrays, and the tint that surfaceAt gives where a ray hits. */
#include "surface.clh"

__kernel void textureValues(__global const Texture* texture, __global const Rgb* texels, __global const float* uvs,
                            __global float* values, uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore3(textureValue(texture, texels, vload2(i, uvs)), i, values);
}

__kernel void tintsAtHits(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                          __global const uint* tables, __global const float* rays, __global float* tints,
                          const SceneTables scene, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    Ray ray;
    ray.origin = vload3(2 * i, rays);
    ray.direction = normalize(vload3(2 * i + 1, rays));
    ray.tMin = 0;
    ray.tMax = INFINITY;
    const Hit hit = intersectClosest(nodes, blocks, &ray);
    const Surface s = surfaceAt(&hit, ray.origin, ray.direction, blocks, tables, &scene);
    vstore3(s.tint[0], i, tints);
}
