/* Stage 3 of a pass: trace one camera path per pixel by the law and take light at its hits.
 * From: camera rays, photon map. To: film.
 * With MAP_CAMERA it is stage 1: where light would be taken from the photon map, camera points are stored for the photons
 * that come later. To: camera points, samples; at the end of the pass addSamples adds these and the splats to the film.
 *
 * At every hit: emission seen straight, through specular events, or as the share of the lobe that was sampled; then, on
 * something non-specular, the classes of light that law.clh names, by density estimation and by emitter sampling;
 * then one lobe is chosen and the path goes on. */
#include "camera.clh"
#include "camera_points.clh"
#include "density.clh"
#include "direct_light.clh"
#include "film.clh"
#include "law.clh"
#include "medium_flight.clh"
#include "medium_light.clh"
#include "splat_sums.clh"
#include "volume_density.clh"

/* Paths whose next contribution is below this share of the first are ended by roulette. */
#define CAMERA_ROULETTE_THRESHOLD 0.05f

typedef struct {
    Ray ray;
    float3 throughput;
    uint d, q;         /* genuine diffuse and quasi-specular scatterings so far */
    uint depth;        /* segments so far; passing a null surface does not start a new one */
    float passed;      /* length of the current segment before the last null surface */
    float3 from;       /* where the current segment began */
    int specularSoFar; /* nothing but specular events: emission counts in full */
    float directPdf;  /* > 0: emission counts by its share against emitter sampling; density of the sampled direction */
    int onlyEmission; /* the path goes on just for that share */
    float firstChoice; /* in [0,1): decides the first event, evenly over the passes; < 0 after it */
#ifdef HAS_MEDIA
    uint medium; /* index or MEDIUM_NONE */
#endif
} CameraPath;

inline uint mediumOf(const CameraPath* path) {
#ifdef HAS_MEDIA
    return path->medium;
#else
    return MEDIUM_NONE;
#endif
}

/* What the kernels of this stage read. */
typedef struct {
    __global const BvhNode* nodes;
    __global const PrimitiveBlock* blocks;
    __global const uint* tables;
#ifdef MAP_CAMERA
    PointStore* store;
#else
    PhotonMap photons;
#endif
    const CameraParams* params;
} World;

/* What `emitter` sends along the path, to the film's components. */
inline void takeRadiance(const CameraPath* path, __global const Emitter* emitter, float distance, float3 normal,
                         float3* components) {
    const float3 radiance = path->throughput * loadRgb(emitter->radiance);
    if (path->specularSoFar) {
        components[FILM_EMISSION] += radiance;
#ifdef DIRECT_BY_EMITTERS
    } else if (path->directPdf > 0) {
        const float lightPdf =
            emitterPdfSolidAngle(emitter, path->from, path->ray.direction, path->passed + distance, normal);
        components[LIGHT_DIRECT] += radiance * (path->directPdf / (path->directPdf + lightPdf));
#endif
    }
}

/* Emission of the surface that the path has met. */
inline void takeEmission(const World* world, const CameraPath* path, const Surface* s, float distance,
                         float3* components) {
    if (s->emitter == QL_NONE || !s->front || path->depth > world->params->maxDepth) return;
    __global const Emitter* emitter = SCENE_TABLE(world->tables, &world->params->scene, Emitter, emitters) + s->emitter;
    takeRadiance(path, emitter, distance, s->geometricNormal, components);
}

/* Radiance of the surroundings, where the path leaves the scene. */
inline void takeSurroundings(const World* world, const CameraPath* path, float3* components) {
    const SceneTables* scene = &world->params->scene;
    __global const Emitter* emitters = SCENE_TABLE(world->tables, scene, Emitter, emitters);
    const uint index = emitterOfSurroundings(emitters, scene->emitterCount);
    if (index == QL_NONE || path->depth > world->params->maxDepth) return;
    takeRadiance(path, emitters + index, INFINITY, -path->ray.direction, components);
}

/* Radiance reflected by the lobes of `mask` from the photons of one class; 0 where it is left to splatting. */
inline float3 takePhotons(const World* world, const CameraPath* path, const Surface* s, const Frame* frame, float3 wo,
                          __global const Lobe* lobes, uint mask, uint lightClass) {
    const CameraParams* params = world->params;
    const uint depthMax = params->maxDepth == QL_NONE ? QL_NONE : params->maxDepth - path->depth;
#ifdef MAP_CAMERA
    storeSurfacePoints(world->store, s, lobes, mask, lightClass, -path->ray.direction, path->throughput, depthMax,
                       params->map.radius[lightClass], world->tables, &params->scene);
    return 0;
#else
    if (slotIsEmpty(world->photons, lightClass)) return 0;
    const DensityRegion region = densityRegionAt(s, params->map.radius[lightClass], world->tables, &params->scene);
    if (!(region.kernelIntegral > 0)) return 0;
    DirectionalLobes directional = {lobes, 0, *frame, wo, s};
    float3 lambert = 0; /* BRDF of the Lambert lobes together */
    for (uint k = 0; k < s->lobeCount; ++k) {
        if (!(mask >> k & 1)) continue;
        if (lobes[k].type == LOBE_LAMBERT)
            lambert += tintedLambert(s, lobes, k);
        else
            directional.mask |= 1u << k;
    }
    const PhotonSums sums =
        gatherPhotons(world->photons, lightClass, &region, s->patch << 1 | s->front, depthMax, &directional);
    return (lambert * sums.irradiance + sums.radiance) / region.kernelIntegral;
#endif
}

/* Probability of going on with each lobe. A lobe that may not scatter any more still takes its share of the direct
 * light by sampling, if it shares; such paths then go on for emission only. */
inline LobeChoice chooseProbabilities(const CameraPath* path, const Surface* s, __global const Lobe* lobes, float3 wo,
                                      uint bdd, uint directMask) {
    LobeChoice choice;
    for (uint k = 0; k < s->lobeCount; ++k) {
        int goesOn = lawMayScatter(lobes[k].scattering, path->d, bdd);
#ifdef DIRECT_BY_EMITTERS
        goesOn = goesOn || (directMask >> k & 1 && lobeSharesDirect(lobes + k));
#endif
        choice.probability[k] = goesOn ? maxComponent(path->throughput * tintedAlbedo(s, lobes, k, wo)) : 0.f;
    }
    choiceFromStrengths(&choice, s->lobeCount, CAMERA_ROULETTE_THRESHOLD);
    return choice;
}

/* Takes every class of light that the law names here. */
inline void takeLight(const World* world, const CameraPath* path, const Surface* s, const Frame* frame, float3 wo,
                      __global const Lobe* lobes, const LobeChoice* choice, Rng* rng, float3* components) {
    const CameraParams* params = world->params;
    uint takers[LIGHT_CLASSES] = {0, 0, 0, 0}; /* lobes that take a class, as bits */
    for (uint k = 0; k < s->lobeCount; ++k) {
        const uint taken = lawLightTaken(lobes[k].scattering, path->d, path->q, params->bdd);
        for (uint c = 0; c < LIGHT_CLASSES; ++c) takers[c] |= (taken >> c & 1) << k;
    }
#ifdef DIRECT_BY_EMITTERS
    if (takers[LIGHT_DIRECT] && path->depth < params->maxDepth) {
        const float uSelect = rngNext(rng);
        const float2 u = rngNext2(rng);
        components[LIGHT_DIRECT] +=
            path->throughput * directLight(s, frame, wo, lobes, takers[LIGHT_DIRECT], choice,
                                           (float3)(uSelect, u.x, u.y), mediumOf(path), world->nodes, world->blocks,
                                           world->tables, &params->scene);
    }
#endif
    for (uint c = 0; c < LIGHT_CLASSES; ++c)
        if ((PHOTON_CLASSES >> c & 1) && takers[c] && path->depth < params->maxDepth)
            components[c] += path->throughput * takePhotons(world, path, s, frame, wo, lobes, takers[c], c);
}

/* Goes on with one lobe; 0 where the path ends. */
inline int scatterCameraPath(const World* world, CameraPath* path, const Surface* s, const Frame* frame, float3 wo,
                             __global const Lobe* lobes, const LobeChoice* choice, Rng* rng) {
    float rest;
    const float random = rngNext(rng);
    const uint k = chooseLobe(choice, s->lobeCount, path->firstChoice < 0 ? random : path->firstChoice, &rest);
    path->firstChoice = -1;
    if (k == s->lobeCount) return 0;
    __global const Lobe* lobe = lobes + k;
    const LobeSample sample = tintedSample(s, lobes, k, wo, rest, rngNext2(rng), TRANSPORT_RADIANCE);
    if (!sample.valid) return 0;
    const float3 wi = toWorld(frame, sample.wi);
    if (!sameSides(s, wi, sample.wi.z)) return 0;
    path->throughput *= sample.weight / choice->probability[k];
    const uint scattering = lobe->scattering;
    if (scattering == SCATTER_SPECULAR) {
        path->directPdf = 0;
    } else {
        const int takesDirect = lawLightTaken(scattering, path->d, path->q, world->params->bdd) >> LIGHT_DIRECT & 1;
        path->directPdf = takesDirect && lobeSharesDirect(lobe) ? choice->probability[k] * sample.pdfSolidAngle : 0.f;
        path->onlyEmission = !lawMayScatter(scattering, path->d, world->params->bdd);
        path->specularSoFar = 0;
        path->d += scattering == SCATTER_GENUINE_DIFFUSE;
        path->q += scattering == SCATTER_QUASI_SPECULAR;
    }
    path->ray = leavingRay(s, wi);
    path->from = s->position;
    path->passed = 0;
#ifdef HAS_MEDIA
    if (sample.wi.z < 0)
        path->medium = mediumBeyond(SCENE_TABLE(world->tables, &world->params->scene, Shape, shapes) + s->shape,
                                    !s->front, path->medium);
#endif
    return 1;
}

#ifdef HAS_MEDIA
/* Takes every class of light that the law names at a collision; `path` has come to it at `position`, its throughput
 * includes the albedo. */
inline void takeLightInMedium(const World* world, const CameraPath* path, float3 position,
                              __global const Medium* medium, Rng* rng, float3* components) {
    const CameraParams* params = world->params;
    const uint kinds = phaseScatterings(medium);
    const uint diffuse =
        kinds & SCATTER_GENUINE_DIFFUSE ? lawLightTaken(SCATTER_GENUINE_DIFFUSE, path->d, path->q, params->bdd) : 0u;
    const uint quasi =
        kinds & SCATTER_QUASI_SPECULAR ? lawLightTaken(SCATTER_QUASI_SPECULAR, path->d, path->q, params->bdd) : 0u;
    const Geometry geometry = {world->nodes, world->blocks, world->tables, &params->scene};
#ifdef DIRECT_IN_MEDIA
    const uint direct = takers(diffuse, quasi, LIGHT_DIRECT);
    if (direct) {
        const float uSelect = rngNext(rng);
        const float2 u = rngNext2(rng);
        components[LIGHT_DIRECT] +=
            path->throughput * directLightInMedium(&geometry, medium, path->medium, position, path->ray.direction,
                                                   direct, phaseSurvival(path->throughput),
                                                   (float3)(uSelect, u.x, u.y));
    }
#endif
    const float3 wo = -path->ray.direction;
    const uint depthMax = params->maxDepth == QL_NONE ? QL_NONE : params->maxDepth - path->depth;
    const float2 u = rngNext2(rng);
    for (uint c = 0; c < LIGHT_CLASSES; ++c) {
        const uint parts = takers(diffuse, quasi, c);
        if (!(PHOTON_CLASSES >> VOLUME_SLOT(c) & 1) || !parts) continue;
#ifdef MAP_CAMERA
        const VolumeRegion region = volumeRegionAt(&geometry, medium, position, c, params->map.volumeScale, u);
        storeVolumePoint(world->store, &region, position, path->medium, parts, c, wo, path->throughput, depthMax);
#else
        if (slotIsEmpty(world->photons, VOLUME_SLOT(c))) continue;
        const VolumeRegion region = volumeRegionAt(&geometry, medium, position, c, params->map.volumeScale, u);
        components[c] += path->throughput * gatherVolumePhotons(world->photons, c, medium - path->medium, path->medium,
                                                                &region, wo, parts, depthMax);
#endif
    }
}

/* A collision: light is taken and the path scattered; 0 where it ends. */
inline int collideCameraPath(const World* world, CameraPath* path, const FreeFlight* flight,
                             __global const Medium* medium, Rng* rng, float3* components) {
    const CameraParams* params = world->params;
    if (path->passed == 0) ++path->depth;
    if (path->onlyEmission || path->depth >= params->maxDepth) return 0;
    path->throughput *= flight->weight * loadRgb(medium->albedo);
    const float3 position = path->ray.origin + flight->distance * path->ray.direction;
    takeLightInMedium(world, path, position, medium, rng, components);

    int quasiOnly = !lawMayScatter(SCATTER_GENUINE_DIFFUSE, path->d, params->bdd);
#ifdef DIRECT_IN_MEDIA
    quasiOnly = quasiOnly && !phaseSharesDirect(medium, SCATTER_GENUINE_DIFFUSE);
    const float directSurvival = phaseSurvival(path->throughput); /* as takeLightInMedium weighs with */
#endif
    const PhaseSample sample = phaseSample(medium, path->ray.direction, quasiOnly, rng);
    if (!sample.valid) return 0;
    const uint scattering = sample.scattering;
    path->throughput *= sample.weight;
    const float survival = phaseSurvival(path->throughput);
    if (rngNext(rng) >= survival) return 0;
    path->throughput /= survival;
    path->directPdf = 0;
#ifdef DIRECT_IN_MEDIA
    if (lawLightTaken(scattering, path->d, path->q, params->bdd) >> LIGHT_DIRECT & 1 &&
        phaseSharesDirect(medium, scattering))
        path->directPdf = directSurvival * phasePart(medium, scattering, sample.p);
#endif
    path->onlyEmission = !lawMayScatter(scattering, path->d, params->bdd);
    if (path->onlyEmission && path->directPdf == 0) return 0;
    path->specularSoFar = 0;
    path->d += scattering == SCATTER_GENUINE_DIFFUSE;
    path->q += scattering == SCATTER_QUASI_SPECULAR;
    path->ray.origin = position;
    path->ray.direction = sample.direction;
    path->ray.tMin = 0;
    path->ray.tMax = INFINITY;
    path->from = position;
    path->passed = 0;
    return 1;
}
#endif

/* One segment of the path and what happens at its end; 0 where the path ends. */
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
        path->firstChoice = path->firstChoice < 0 ? -1 : numberLeft(medium, &segment.flight, u.x);
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
#if defined(HAS_NULL_PRIMITIVES) || defined(HAS_MEDIA)
    if (s.isNull) {
        const float tMax = path->ray.tMax;
        path->ray = leavingRay(&s, path->ray.direction);
        path->ray.tMax = tMax - hit.t; /* the far clipping plane stays */
        path->passed += max(hit.t, FLT_MIN);
#ifdef HAS_MEDIA
        path->medium =
            mediumBeyond(SCENE_TABLE(world->tables, &params->scene, Shape, shapes) + s.shape, !s.front, path->medium);
#endif
        return 1;
    }
#endif
    if (path->onlyEmission || s.lobeCount == 0) return 0;
    __global const Lobe* lobes = SCENE_TABLE(world->tables, &params->scene, Lobe, lobes) + s.firstLobe;
    const Frame frame = frameFromNormal(s.shadingNormal);
    const float3 wo = toLocal(&frame, -path->ray.direction);
    uint directMask = 0;
    for (uint k = 0; k < s.lobeCount; ++k)
        directMask |= (lawLightTaken(lobes[k].scattering, path->d, path->q, params->bdd) >> LIGHT_DIRECT & 1) << k;
    const LobeChoice choice = chooseProbabilities(path, &s, lobes, wo, params->bdd, directMask);
    takeLight(world, path, &s, &frame, wo, lobes, &choice, rng, components);
    if (path->depth >= params->maxDepth) return 0;
    return scatterCameraPath(world, path, &s, &frame, wo, lobes, &choice, rng);
}

/* Light that the path of a pixel takes, by component. Returns the throughput, mean of R, G, B, with which it was cut, or
 * -1 where it ended by itself. */
inline float traceCameraPath(const World* world, uint pixel, float3* components) {
    const CameraParams* params = world->params;
    const ulong seed = (ulong)params->seedHigh << 32 | params->seedLow;
    Rng rng = rngMake(seed, params->pass, STREAM_CAMERA, pixel);
    CameraPath path;
    const float3 even = pixelNumbers(pixel, params->pass, seed);
    path.ray = cameraRay(&params->camera, pixel, even.xy);
    path.firstChoice = even.z;
    path.throughput = 1;
    path.d = path.q = path.depth = 0;
    path.passed = 0;
    path.from = path.ray.origin;
    path.specularSoFar = 1;
    path.directPdf = 0;
    path.onlyEmission = 0;
#ifdef HAS_MEDIA
    path.medium = params->camera.medium;
#endif
    for (uint k = 0; k < FILM_COMPONENTS; ++k) components[k] = 0;
    uint event = 0;
    while (event < PATH_EVENTS_MAX && followCameraPath(world, &path, &rng, components)) ++event;
    return event < PATH_EVENTS_MAX ? -1 : (path.throughput.x + path.throughput.y + path.throughput.z) / 3;
}

inline void addFiniteSample(__global float* film, __global CameraCounters* counters, uint pixel,
                            const float3* components) {
    float3 total = 0;
    for (uint k = 0; k < FILM_COMPONENTS; ++k) total += components[k];
    if (all(isfinite(total)))
        addSample(film, pixel, components);
    else
        atomic_inc(&counters->nonFinite);
}

#ifndef MAP_CAMERA
__kernel void traceCameraPaths(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                               __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                               __global float* film, __global CameraCounters* counters, const CameraParams params) {
    const uint pixel = get_global_id(0);
    if (pixel >= params.camera.width * params.camera.height) return;
    const World world = {nodes, blocks, tables, {sorted, cellStart, &params.map}, &params};
    float3 components[FILM_COMPONENTS];
    const float cut = traceCameraPath(&world, pixel, components);
    if (cut >= 0) {
        atomic_inc(&counters->cutPaths);
        atomic_add(&counters->cutThroughput, (uint)(min(cut, 1e3f) * CUT_THROUGHPUT_STEPS + 0.5f));
    }
    addFiniteSample(film, counters, pixel, components);
}
#else
/* Light that needs no photons is of these components only. */
#define SAMPLE_FLOATS 6

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
    const uint last = min(first + store.pixelsPerRegion, params.camera.width * params.camera.height);
    for (uint pixel = first; pixel < last; ++pixel) {
        own.pixel = pixel;
        float3 components[FILM_COMPONENTS];
        const float cut = traceCameraPath(&world, pixel, components);
        if (cut >= 0) {
            ++own.count.cutPaths;
            own.count.cutThroughput += cut;
        }
        vstore3(components[LIGHT_DIRECT], 0, samples + (size_t)pixel * SAMPLE_FLOATS);
        vstore3(components[FILM_EMISSION], 1, samples + (size_t)pixel * SAMPLE_FLOATS);
    }
    counts[region] = own.count;
}

/* Ends the pass: the sample of a pixel is what its path took and what photons have splatted to it. */
__kernel void addSamples(__global const float* samples, __global uint* sums, __global float* film,
                         __global CameraCounters* counters, const uint pixels, const float quantaPerRadiance) {
    const uint pixel = get_global_id(0);
    if (pixel >= pixels) return;
    float3 components[FILM_COMPONENTS];
    for (uint c = 0; c < LIGHT_CLASSES; ++c)
        components[c] = SPLAT_CLASSES >> c & 1 ? takeSplats(sums, pixel, c) / quantaPerRadiance : (float3)(0);
    components[LIGHT_DIRECT] += vload3(0, samples + (size_t)pixel * SAMPLE_FLOATS);
    components[FILM_EMISSION] = vload3(1, samples + (size_t)pixel * SAMPLE_FLOATS);
    addFiniteSample(film, counters, pixel, components);
}
#endif
