/* Marks the photons that the camera paths of a pass gather: what share of the map serves the image
 * (docs/method/learning.md). A program of its own, with MARKS_GATHERED, which a render runs once, after its passes, if
 * it is asked to. From: camera rays, photon map. To: a bit for each photon. */
#include "camera_paths.cl"

/* Pixels, or places in the grid of samples. */
inline uint placeCount(const CameraParams* params) {
#ifdef SHARES_SAMPLES
    return gridColumns(&params->camera) * (params->camera.height + 2 * SAMPLE_BORDER(&params->camera));
#else
    return params->camera.width * params->camera.height;
#endif
}

__kernel void markGathered(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                           __global uint* marks, const CameraParams params, __global const uint* pathCounts
#ifdef ADAPTIVE_RADIUS
                           ,
                           __global const float* radiusScales
#endif
) {
    const uint index = get_global_id(0);
    if (index >= placeCount(&params)) return;
    const World world = {nodes,        blocks, tables, {sorted, cellStart, &params.map, marks}, pathCounts,
#ifdef ADAPTIVE_RADIUS
                         radiusScales,
#endif
                         &params};
    float3 components[FILM_SAMPLES];
    const uint paths = pathsAt(&world, index);
    traceCameraPath(&world, index, roleOfPath(&params, gathersApart(&params, paths) ? paths : 0, paths), components);
}
