/* Density regions and estimates of irradiance at given surface points. */
#include "micro/gather_photons.clh"

/* As tests/support/density_scene.h has them. */
typedef struct {
    Packed3 position, normal;
    uint primitive;
    float radius;
    uint firstPatch;
} RegionQuery;

typedef struct {
    float kernelIntegral, radiusSquared;
    uint bordered;
    Packed3 axisS, axisT;
    float correctionA, correctionB, correctionC;
    float reachSquared[SECTORS];
} RegionAnswer;

inline Packed3 pack(float3 v) {
    Packed3 p = {v.x, v.y, v.z};
    return p;
}

inline Surface surfaceOf(__global const RegionQuery* query, __global const uint* tables, const SceneTables* scene) {
    Surface s;
    s.position = load3(query->position);
    s.geometricNormal = s.shadingNormal = load3(query->normal);
    s.patch = query->firstPatch + SCENE_TABLE(tables, scene, PrimitiveInfo, primitives)[query->primitive].patch;
    s.front = 1;
    return s;
}

__kernel void findRegions(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                          __global const uint* tables, __global const RegionQuery* queries,
                          __global RegionAnswer* answers, const SceneTables scene, const uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Surface s = surfaceOf(queries + i, tables, &scene);
    const DensityRegion region = densityRegionAt(&s, queries[i].radius, nodes, blocks, tables, &scene);
    __global RegionAnswer* answer = answers + i;
    answer->kernelIntegral = region.kernelIntegral;
    answer->radiusSquared = region.radiusSquared;
    answer->bordered = region.bordered;
    answer->axisS = pack(region.frame.s);
    answer->axisT = pack(region.frame.t);
    const BorderCorrection correction = borderCorrection(&region);
    answer->correctionA = correction.a;
    answer->correctionB = correction.b;
    answer->correctionC = correction.c;
    for (uint k = 0; k < SECTORS; ++k)
        answer->reachSquared[k] = region.bordered ? region.reachSquared[k] : region.radiusSquared;
}

/* As tests/support/density_scene.h has it. */
typedef struct {
    float byRegion; /* irradiance by the region, red */
    float sloped;   /* the same, green */
    /* The sum over the whole disc divided by the integral over it, as without any care for borders; red */
    float byDisc;
} Estimate;

__kernel void estimate(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                       __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                       __global const RegionQuery* queries, __global Estimate* estimates, const SceneTables scene,
                       const MapParams map, const uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Surface s = surfaceOf(queries + i, tables, &scene);
    const PhotonMap photons = {sorted, cellStart, &map};
    DirectionalLobes none = {0, 0, frameFromNormal(s.geometricNormal), (float3)(0, 0, 1), &s};
    DensityRegion region = densityRegionAt(&s, queries[i].radius, nodes, blocks, tables, &scene);
    const float3 inRegion =
        gatherPhotons(photons, LIGHT_DIFFUSE, &region, s.patch << 1 | s.front, QL_NONE, &none).irradiance;
    estimates[i].byRegion = region.kernelIntegral > 0 ? inRegion.x / region.kernelIntegral : 0.f;
    estimates[i].sloped = region.kernelIntegral > 0 ? inRegion.y / region.kernelIntegral : 0.f;
    region.bordered = 0;
    const float inDisc =
        gatherPhotons(photons, LIGHT_DIFFUSE, &region, s.patch << 1 | s.front, QL_NONE, &none).irradiance.x;
    estimates[i].byDisc = inDisc / regionIntegral(&region);
}
