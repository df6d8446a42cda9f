/* Regions of density estimates in a medium, kernels/volume_region.clh, of the scene's first medium. */
#include "volume_region.clh"

/* Weights of the kernel and of its square about a point, in kernel space. */
typedef struct {
    float a, b[3], squaredA, squaredB[3], inverseVolume;
} RegionWeights;

/* `numbers`: two for each region. */
__kernel void regionsAt(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                        __global const uint* tables, const SceneTables scene, const float4 point, const float scale,
                        __global const float* numbers, __global RegionWeights* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Geometry geometry = {nodes, blocks, tables, &scene};
    __global const Medium* medium = SCENE_TABLE(tables, &scene, Medium, media);
    const VolumeRegion region = volumeRegionAt(&geometry, medium, point.xyz, LIGHT_DIFFUSE, scale, vload2(i, numbers));
    result[i].a = region.a;
    vstore3(region.b, 0, result[i].b);
    result[i].squaredA = region.squaredA;
    vstore3(region.squaredB, 0, result[i].squaredB);
    result[i].inverseVolume = region.inverseVolume;
}
