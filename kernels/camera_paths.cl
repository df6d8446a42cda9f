/* Stage 3 of a pass: trace camera paths, one or several per pixel, by the law and take light at its hits.
 * From: camera rays, photon map. To: film.
 * With SHARES_SAMPLES: to samples, from which filterSamples makes pixels.
 * With MAP_CAMERA it is stage 1: where light would be taken from the photon map, camera points are stored for the photons
 * that come later. To: camera points, samples; at the end of the pass addSamples adds these and the splats to the film.
 *
 * At every hit: emission seen straight, through specular events, or as the share of the lobe that was sampled; then, on
 * something non-specular, the classes of light that law.clh names, by density estimation and by emitter sampling;
 * then one lobe is chosen and the path goes on. */
#include "camera.clh"
#include "camera_medium.clh"
#include "camera_surface.clh"
#include "shared_samples.clh"
#ifdef HAS_METER
#include "meter.clh"
#endif

/* One segment of the path and what happens at its end; 0 where the path ends. It ends
 *   - where it leaves the scene, after the light of the surroundings is taken;
 *   - at its next surface or collision where it went on for emission only (genuine diffuse, d = BDD: law.clh);
 *   - on a surface without lobes, which absorbs everything;
 *   - where it has as many segments as the scene's max_depth allows, after light is taken;
 *   - where a bent normal looks away from it (relief.clh);
 *   - where no lobe is chosen: none may scatter any more (law.clh), or roulette ends it (scatterCameraPath);
 *   - where the sampled direction lies below the horizon, or on different sides of the shading normal and of the surface;
 *   - in a medium where the part of the phase function that was sampled may not scatter, or by roulette (collideCameraPath);
 *   - after PATH_EVENTS_MAX events: cut, and counted (traceCameraPath).
 * Where a surface ends it for emission only, for its segments or for its normal, what the surface lets pass goes on (passOnly). */
inline int followCameraPath(const World* world, CameraPath* path, Rng* rng, float3* components) {
    const CameraParams* params = world->params;
    Hit hit;
#ifdef HAS_MEDIA
    if (inMedium(path->medium)) {
        __global const Medium* medium = SCENE_TABLE(world->tables, &params->scene, Medium, media) + path->medium;
        float2 u = rngNext2(rng);
        if (path->firstChoice >= 0) u.x = path->firstChoice;
        const MediumSegment segment = followMedium(medium, path->throughput, &path->ray, 0, u, world->nodes,
                                                   world->blocks, world->tables, &params->scene);
        path->firstChoice = path->firstChoice < 0
                                ? -1
                                : numberLeft(medium, path->ray.origin, path->ray.direction, &segment.flight, u.x);
        if (segment.flight.collided) return collideCameraPath(world, path, &segment.flight, medium, rng, components);
        path->throughput *= segment.flight.weight;
        hit = segment.hit;
    } else
#endif
        hit = intersectClosest(world->nodes, world->blocks, path->ray);
    if (hit.primitive == QL_NONE) {
        if (path->passed == 0) ++path->depth;
        takeSurroundings(world, path, components);
        return 0;
    }
    const Surface s =
        surfaceAt(hit, path->ray.origin, path->ray.direction, world->blocks, world->tables, &params->scene);
    if (path->passed == 0) ++path->depth;
    takeEmission(world, path, &s, hit.t, components);
#if defined(HAS_NULL_PRIMITIVES) || defined(HAS_MEDIA) || defined(HAS_HIDDEN_EMITTERS)
    if (s.isNull || (s.emitter != QL_NONE && looksThroughEmitters(path))) {
        crossSurface(world, path, &s, hit.t);
        return 1;
    }
#endif
    if (s.lobeCount == 0) return 0;
    __global const Lobe* lobes = SCENE_TABLE(world->tables, &params->scene, Lobe, lobes) + s.firstLobe;
    const Frame frame = shadingFrame(&s);
    const float3 wo = toLocal(&frame, -path->ray.direction);
#ifdef HAS_LOBE_PASSAGE
    if (path->onlyEmission || path->depth >= params->maxDepth || looksAway(&s, wo))
        return passOnly(world, path, &s, lobes, hit.t, rng);
#else
    if (path->onlyEmission || looksAway(&s, wo)) return 0;
#endif
    uint directMask = 0;
    for (uint k = 0; k < s.lobeCount; ++k)
        directMask |= (lightTaken(lobes[k].scattering, path, params) >> LIGHT_DIRECT & 1) << k;
    const LobeChoice choice = chooseProbabilities(path, &s, lobes, wo, params->bdd, directMask, &params->scene);
    takeLight(world, path, &s, &frame, wo, lobes, &choice, rng, components);
    if (path->depth >= params->maxDepth) return 0;
    return scatterCameraPath(world, path, &s, &frame, wo, lobes, &choice, hit.t, rng);
}

/* Work-items of a pixel in a pass: one, of a meter several. */
inline uint pathsPerPixel(const CameraParams* params) {
#ifdef HAS_METER
    return params->scene.meter.samples;
#else
    return 1;
#endif
}

inline uint pathCount(const CameraParams* params) {
    return params->camera.width * params->camera.height * pathsPerPixel(params);
}

typedef struct {
    uint pixel;         /* of the image, or the nearest one */
    FilterPlace inside; /* from its centre */
} PathPlace;

/* Where path `index` begins; `even` in [0,1)^2. */
inline PathPlace pathPlace(const World* world, uint index, float2 even) {
    const CameraParams* params = world->params;
    PathPlace place;
#ifdef SHARES_SAMPLES
    const int columns = gridColumns(&params->camera);
    const int2 at = (int2)(index % columns, index / columns) - (int)SAMPLE_BORDER(&params->camera);
    const int2 nearest = clamp(at, 0, (int2)(params->camera.width, params->camera.height) - 1);
    place.pixel = nearest.y * params->camera.width + nearest.x;
    place.inside.offset = gridPlace(params) - 0.5f + convert_float2(at - nearest);
    place.inside.weight = 1;
#else
    place.pixel = index / pathsPerPixel(params);
    place.inside = filterPlace(&params->camera, world->tables, place.pixel, even);
#endif
    place.inside.offset *= params->spread;
    return place;
}

/* A wrong rule, as a negative control for tests. 1: the path that gathers counts as if there were four in all pixels. */
#ifndef SAMPLING_RULE
#define SAMPLING_RULE 0
#endif

/* Of path `k` of the `paths` of its pixel in a pass. Gathering costs most of a path, and what photons carry differs little between the paths of a pixel: the
 * first ones gather for all (docs/method/camera-paths.md). */
inline float gatheringWeight(const CameraParams* params, uint k, uint paths) {
    const uint all = SAMPLING_RULE == 1 ? 4 : paths;
    return k < params->gatheringPaths ? (float)all / params->gatheringPaths : 0.f;
}

/* Path `number` of those of `index`, where it leaves the camera: nothing has happened to it. */
inline CameraPath beginCameraPath(const World* world, uint index, uint number, uint paths, ulong seed,
                                  const PathPlace* place) {
    const CameraParams* params = world->params;
    const uint pixel = place->pixel;
    CameraPath path;
    path.ray = cameraRay(&params->camera, pixel, place->inside.offset, lensNumbers(index, number, seed));
    path.net = netOfPath(seed, number, paths, index);
    const float3 ofLobe = netNumbers(&path.net, NET_LOBE);
    path.firstChoice = ofLobe.x;
    path.firstPair = ofLobe.yz;
#ifdef ADAPTIVE_RADIUS
    path.radiusBlock = radiusBlock(params, pixel);
#endif
    const uint columns = params->camera.width * params->coarseness;
    const uint2 ofImage = params->coarseness * (uint2)(pixel % params->camera.width, pixel / params->camera.width);
    path.lightBlock = lightBlock(&params->scene, columns, ofImage.y * columns + ofImage.x);
    path.gathering = gatheringWeight(params, number % paths, paths);
    path.directSamples = 1;
#ifdef MIXED_DIRECT
    path.lastDiffuse = 0;
#endif
    path.throughput = 1;
    path.radianceScale = 1;
    path.d = path.q = path.depth = 0;
    path.passed = 0;
    path.from = path.ray.origin;
    path.specularSoFar = 1;
    path.takesCaustics = path.specularSince = 0;
    path.directPdf = 0;
    path.onlyEmission = 0;
#ifdef HAS_MEDIA
    path.medium = params->camera.medium;
    path.roulette.number = pixelRoulette(index, number, seed);
    path.roulette.survival = 1;
#endif
    return path;
}

/* Light that a path takes, by component, and its bias; paths of a pixel follow each other in `index`. `number`: of the path among all that
 * have the same index, over the passes, each of which has `paths` of them. Returns the throughput, mean of R, G, B, with which it was cut, or -1 where it
 * ended by itself. */
inline float traceCameraPath(const World* world, uint index, uint number, uint paths, float3* components) {
    const CameraParams* params = world->params;
    const ulong seed = (ulong)params->seedHigh << 32 | params->seedLow;
    Rng rng = rngMake(seed, number, STREAM_CAMERA, index);
    const PathPlace place = pathPlace(world, index, pixelPlace(index, number, seed));
    CameraPath path = beginCameraPath(world, index, number, paths, seed, &place);
    for (uint k = 0; k < FILM_SAMPLES; ++k) components[k] = 0;
    if (isBeyondImage(&path.ray)) return -1;
#ifdef HAS_DEPTH_LIMIT
    if (params->maxDepth == 0) return -1; /* not even emitters are seen */
#endif
#ifdef HAS_IRRADIANCE_METER
    const MeterSequence sequence = {index % pathsPerPixel(params), pathsPerPixel(params),
                                    rngMake(seed, params->pass, STREAM_PIXEL, place.pixel).key};
    leaveMeter(world, &path, &sequence, place.pixel, &rng, components);
#endif
#if defined(HAS_FILTER_TABLE) && defined(MAP_CAMERA)
    world->store->filterWeight = place.inside.weight;
#endif
    uint event = 0;
    while (event < PATH_EVENTS_MAX && followCameraPath(world, &path, &rng, components)) ++event;
    if (params->countsEvents)
        for (uint k = 0; k < FILM_SAMPLES; ++k) components[k] = k == 0 ? event + 1 : 0;
#ifdef HAS_FILTER_TABLE
    for (uint k = 0; k < FILM_SAMPLES; ++k) components[k] *= place.inside.weight;
#endif
    return event < PATH_EVENTS_MAX ? -1 : (path.throughput.x + path.throughput.y + path.throughput.z) / 3;
}

/* `cut` as traceCameraPath returns it. */
inline void countCut(__global CameraCounters* counters, float cut) {
    if (cut < 0) return;
    atomic_inc(&counters->cutPaths);
    atomic_add(&counters->cutThroughput, (uint)(min(cut, 1e3f) * CUT_THROUGHPUT_STEPS + 0.5f));
}

#if !defined(HAS_METER) && !defined(MAP_CAMERA)
/* Camera paths in this pass, of a pixel or of a place in the grid of samples; of such beyond the edge, those of the nearest pixel. */
inline uint pathsAt(const World* world, uint index) {
    const CameraParams* params = world->params;
    return world->pathCounts[blockOfPixel(&params->camera, pathPlace(world, index, 0).pixel, params->pathBlock)];
}

/* The mean of the paths of a pixel, or of a place in the grid of samples, in this pass. They look up the same photons, so photons, which cost
 * more, are traced once for all. */
inline void tracePixel(const World* world, uint index, __global CameraCounters* counters, float3* mean) {
    const uint paths = pathsAt(world, index);
    for (uint k = 0; k < FILM_SAMPLES; ++k) mean[k] = 0;
    for (uint path = 0; path < paths; ++path) {
        float3 components[FILM_SAMPLES];
        countCut(counters, traceCameraPath(world, index, world->params->pass * paths + path, paths, components));
        for (uint k = 0; k < FILM_SAMPLES; ++k) mean[k] += components[k];
    }
    for (uint k = 0; k < FILM_SAMPLES; ++k) mean[k] /= paths;
}
#endif

/* A sample that is not finite counts as none. */
inline void dropNonFinite(__global CameraCounters* counters, float3* components) {
    float3 total = 0;
    for (uint k = 0; k < FILM_COMPONENTS; ++k) total += components[k];
    if (all(isfinite(total))) return;
    atomic_inc(&counters->nonFinite);
    for (uint k = 0; k < FILM_SAMPLES; ++k) components[k] = 0;
}

/* The batch of passes that a sample may end is closed whether it is finite or not. */
inline void addFiniteSample(__global float* film, uint layout, __global CameraCounters* counters, uint pixel,
                            float3* components, float batchWeight) {
    dropNonFinite(counters, components);
    addSample(film, layout, pixel, components, batchWeight);
}

/* Sum over the `paths` of a pixel of the component in this place of their samples, compensated (Kahan 1965): a meter has
 * thousands of them. */
inline float3 sumOfPaths(__global const float* samples, uint floatsPerPath, uint pixel, uint paths, uint place) {
    float3 sum = 0, lost = 0;
    for (uint k = 0; k < paths; ++k) {
        const float3 value = vload3(place, samples + ((size_t)pixel * paths + k) * floatsPerPath) - lost;
        const float3 next = sum + value;
        lost = (next - sum) - value;
        sum = next;
    }
    return sum;
}

#if defined(HAS_METER) && !defined(MAP_CAMERA)
#define SAMPLE_FLOATS (3 * FILM_COMPONENTS)

__kernel void traceMeterPaths(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                              __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                              __global float* samples, __global CameraCounters* counters, const CameraParams params) {
    const uint index = get_global_id(0);
    if (index >= pathCount(&params)) return;
    const World world = {nodes, blocks, tables, {sorted, cellStart, &params.map}, &params};
    float3 components[FILM_COMPONENTS];
    countCut(counters, traceCameraPath(&world, index, params.pass, 1, components));
    for (uint k = 0; k < FILM_COMPONENTS; ++k) vstore3(components[k], k, samples + (size_t)index * SAMPLE_FLOATS);
}

/* Ends the pass: the sample of a pixel is the mean of its paths and the photons counted in it (meter_photons.clh), times
 * `scale`. */
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
#elif !defined(MAP_CAMERA)
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
#else
/* A sample that waits for its splats is light that needs no photons: direct light and emission. */

/* One work-item: the pixels of one region. */
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
        const float cut = traceCameraPath(&world, index, params.pass, 1, components);
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
#endif
