/* Stage 1 of a pass in the camera map's order: where light would be taken from the photon map, camera points are stored
 * for the photons that come later. At the end of the pass addSamples adds what paths took themselves, and the splats,
 * to the film. From: camera rays. To: camera points, samples. */
#include "camera_paths.clh"

/* One work-item: the pixels of one region. Samples are light that needs no photons, direct light and emission, and wait
 * for their splats. */
__kernel void traceCameraPoints(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                                __global const uint* tables, __global CameraPoint* points,
                                __global PointBorder* borders, __global float* samples,
                                __global PointRegionCount* counts, const CameraParams params, const PointParams store) {
    const uint region = get_global_id(0);
    if (region >= store.map.regions) return;
    PointStore own;
    own.points = points + (size_t)region * store.map.regionCapacity;
    own.firstBorder = region * store.borderCapacity;
    own.borders = borders + own.firstBorder;
    own.capacity = store.map.regionCapacity;
    own.borderCapacity = store.borderCapacity;
    own.count.stored = own.count.wanted = own.count.storedBorders = own.count.wantedBorders = own.count.cutPaths = 0;
    own.count.cutThroughput = 0;
    const World world = {nodes, blocks, tables, &own, &params};
    const uint first = region * store.pixelsPerRegion;
    const uint last = min(first + store.pixelsPerRegion, pathCount(&params));
    for (uint index = first; index < last; ++index) {
        own.pixel = index / pathsPerPixel(&params);
        float3 components[FILM_SAMPLES];
        const float cut = traceCameraPath(&world, index, onlyPath(params.pass), components);
        if (cut >= 0) {
            ++own.count.cutPaths;
            own.count.cutThroughput += cut;
        }
        vstore3(components[LIGHT_DIRECT], 0, samples + (size_t)index * CAMERA_SAMPLE_FLOATS);
        vstore3(components[FILM_EMISSION], 1, samples + (size_t)index * CAMERA_SAMPLE_FLOATS);
    }
    counts[region] = own.count;
}

/* Ends the pass: the sample of a pixel is what its paths took and what photons have splatted to it, times `scale`. */
__kernel void addSamples(__global const float* samples, __global uint* sums, __global float* film,
                         __global CameraCounters* counters, const uint pixels, const uint samplesPerPixel,
                         const float scale, const float quantaPerRadiance, const float batchWeight, const uint layout) {
    const uint pixel = get_global_id(0);
    if (pixel >= pixels) return;
    float3 components[FILM_SAMPLES];
    for (uint c = 0; c < LIGHT_CLASSES; ++c)
        components[c] = SPLAT_CLASSES >> c & 1 ? takeSplats(sums, pixel, c) / quantaPerRadiance : (float3)(0);
    components[LIGHT_DIRECT] += sumOfPaths(samples, CAMERA_SAMPLE_FLOATS, pixel, samplesPerPixel, 0);
    components[FILM_EMISSION] = sumOfPaths(samples, CAMERA_SAMPLE_FLOATS, pixel, samplesPerPixel, 1);
    for (uint c = 0; c < FILM_SAMPLES; ++c) components[c] *= scale;
    addFiniteSample(film, layout, counters, pixel, components, batchWeight);
}
