/* Stage 3 of a pass: trace camera paths, one or several per pixel, by the law and take light at their hits.
 * From: camera rays, photon map. To: film.
 * With SHARES_SAMPLES: to samples, from which filterSamples makes pixels. */
#include "camera_paths.clh"

#ifdef HAS_METER
#define SAMPLE_FLOATS (3 * FILM_COMPONENTS)

__kernel void traceMeterPaths(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                              __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                              __global float* samples, __global CameraCounters* counters, const CameraParams params) {
    const uint index = get_global_id(0);
    if (index >= pathCount(&params)) return;
    const World world = {nodes, blocks, tables, {sorted, cellStart, &params.map}, &params};
    float3 components[FILM_COMPONENTS];
    countCut(counters, traceCameraPath(&world, index, onlyPath(params.pass), components));
    for (uint k = 0; k < FILM_COMPONENTS; ++k) vstore3(components[k], k, samples + (size_t)index * SAMPLE_FLOATS);
}

/* Ends the pass: the sample of a pixel is the mean of its paths and the photons counted in it (meter_photons.clh),
 * times `scale`. */
__kernel void addMeterSamples(__global const float* samples, __global uint* sums, __global float* film,
                              __global CameraCounters* counters, const uint pixels, const uint samplesPerPixel,
                              const float scale, const float quantaPerRadiance, const float batchWeight,
                              const uint layout) {
    const uint pixel = get_global_id(0);
    if (pixel >= pixels) return;
    float3 components[FILM_COMPONENTS];
    for (uint c = 0; c < FILM_COMPONENTS; ++c) {
        float3 sum = sumOfPaths(samples, SAMPLE_FLOATS, pixel, samplesPerPixel, c);
#ifdef HAS_METER_PHOTONS
        if (c < LIGHT_CLASSES && SPLAT_CLASSES >> c & 1) sum += takeSplats(sums, pixel, c) / quantaPerRadiance;
#endif
        components[c] = sum * scale;
    }
    addFiniteSample(film, layout, counters, pixel, components, batchWeight);
}
#else
/* Camera paths in this pass, of a pixel or of a place in the grid of samples; of such beyond the edge, those of the
 * nearest pixel. */
inline uint pathsAt(const World* world, uint index) {
    const CameraParams* params = world->params;
    return world->pathCounts[blockOfPixel(&params->camera, pathPlace(world, index, 0).pixel, params->pathBlock)];
}

/* The mean of the paths of a pixel, or of a place in the grid of samples, in this pass, or what its part adds to that.
 * They look up the same photons, so photons, which cost more, are traced once for all. */
inline void tracePixel(const World* world, uint index, __global CameraCounters* counters, float3* mean) {
    const uint paths = pathsAt(world, index), all = paths + gathersApart(world->params, paths);
    for (uint k = 0; k < FILM_SAMPLES; ++k) mean[k] = 0;
    for (uint path = 0; path < all; ++path) {
        float3 components[FILM_SAMPLES];
        countCut(counters, traceCameraPath(world, index, roleOfPath(world->params, path, paths), components));
        for (uint k = 0; k < FILM_SAMPLES; ++k) mean[k] += components[k];
    }
    for (uint k = 0; k < FILM_SAMPLES; ++k) mean[k] /= paths * world->params->parts;
}

__kernel void traceCameraPaths(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                               __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                               __global float* result, __global CameraCounters* counters, const CameraParams params,
                               __global const uint* pathCounts
#ifdef ADAPTIVE_RADIUS
                               ,
                               __global const float* radiusScales
#endif
) {
    const uint place = get_global_id(0); /* in this part of the film, or of the grid of samples */
    if (place >= params.pixels) return;
    const World world = {nodes,        blocks, tables, {sorted, cellStart, &params.map}, pathCounts,
#ifdef ADAPTIVE_RADIUS
                         radiusScales,
#endif
                         &params};
    float3 components[FILM_SAMPLES];
    const uint index = params.firstPixel + place;
    tracePixel(&world, index, counters, components);
#ifdef SHARES_SAMPLES
    dropNonFinite(counters, components);
    const int columns = gridColumns(&params.camera);
    __global float* sample = result + gridSlot(&params, index % columns, index / columns);
    for (uint k = 0; k < FILM_SAMPLES; ++k) vstore3(components[k], k, sample);
#else
    addFiniteSample(result, params.filmLayout, counters, place, components, params.batchWeight);
#endif
}
#endif
