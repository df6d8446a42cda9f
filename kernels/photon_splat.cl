/* Stage 3 of a pass in the camera map's order: trace photons from the emitters and splat them to camera points.
 * From: emitters, camera points. To: sums of splats. */
#include "photon_trace.clh"

__kernel void splatPhotons(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                           __global const CameraPoint* points, __global const PointBorder* borders, __global uint* sums,
                           __global RegionCount* counts, const PhotonParams params, const PointParams store) {
    const uint region = get_global_id(0);
    if (region >= params.regions) return;
    const SplatTarget target = {{sorted, cellStart, &store.map}, points, borders, sums, blocks, tables, &params.scene,
                                store.quantaPerRadiance};
    const PhotonWorld world = {nodes, blocks, tables, &params};
    traceRegion(region, &world, &target, counts);
}
