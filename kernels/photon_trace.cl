/* Stage 1 of a pass: trace photons from the emitters and store them by class.
 * From: emitters. To: photons in blocks, chained in an order that is the region's own (so the result does not depend on scheduling).
 * With MAP_CAMERA it is stage 3 and stores nothing: photons are splatted to camera points. To: sums of splats. */
#include "emitter.clh"
#include "energy_balance.clh"
#include "guide.clh"
#include "importance.clh"
#include "lattice.clh"
#include "law.clh"
#include "photon_medium.clh"
#include "photon_path.clh"
#include "photon_scatter.clh"
#include "photon_walk.clh"
#include "splat_sums.clh"
#include "weight_window.clh"

/* Classes of light that the lobes met here can ever take, restricted to those the kernels store. */
inline uint storableClasses(__global const Lobe* lobes, uint count, uint variant) {
    uint classes = 0;
    for (uint k = 0; k < count; ++k) classes |= lawLightPossible(lobes[k].scattering, variant);
    return classes & PHOTON_CLASSES;
}

/* Factor on flux that is stored: photons arrive in proportion to |wi.ng|, and light is reflected in proportion to
 * |wi.ns|, none of it from below the horizon of the shading normal. Where a texture bends it the latter is left to those who gather. */
inline float shadingNormalArrival(const Surface* s) {
#if (defined(HAS_CORNER_NORMALS) || defined(HAS_RELIEF)) && PHOTON_RULE != 4
    return s->arrival;
#else
    return 1.f;
#endif
}

/* Shows the meter a segment of the path that ends after `length`: at a surface, at a collision, or never. */
inline void crossMeter(const PhotonPath* path, float length, const PhotonSink* sink, __global const uint* tables,
                       const SceneTables* scene, RegionCount* count) {
#ifdef HAS_METER_PHOTONS
    const MeterSums sums = meterSumsOf(sink);
#ifdef HAS_MEDIA
    const uint medium = path->medium;
#else
    const uint medium = MEDIUM_NONE;
#endif
    countAtMeter(&sums, path->origin, path->direction, length, path->flux, path->events, medium, tables, scene, count);
#endif
}

/* What is to be known of a photon's beginning while learning. */
inline EmissionRecord recordOf(const EmittedPhoton* photon, __global const uint* tables, const SceneTables* scene) {
    EmissionRecord record = {photon->emitter,
                             0,
                             {photon->position.x, photon->position.y, photon->position.z},
                             {photon->direction.x, photon->direction.y, photon->direction.z},
                             0,
                             photon->inverseDensity,
                             QL_NONE};
#ifdef HAS_EMITTING_TRIANGLES
    __global const Emitter* emitter = SCENE_TABLE(tables, scene, Emitter, emitters) + photon->emitter;
    if (EMITS_BY_TRIANGLE(emitter->type))
        record.element =
            trianglesSelect(emitter, SCENE_TABLE(tables, scene, EmitterTriangle, emitterTriangles), photon->part) -
            emitter->firstTriangle;
#endif
    return record;
}

/* `record`: null but while learning. */
inline PhotonPath emitPhoton(const PhotonWorld* world, const Lattice* lattice, uint index, RegionCount* count,
                             EmissionRecord* record) {
    const PhotonParams* params = world->params;
    const SceneTables* scene = &params->scene;
    PhotonPath path;
    path.rng = rngMake((ulong)params->seedHigh << 32 | params->seedLow, params->pass, STREAM_PHOTON, index);
    /* Leaves of the guide are chosen by stratified numbers, so each gets its share of every pass. */
    const float2 u = rngNext2(&path.rng);
    const float uSelect = min((index + u.x) / params->paths, 0x1.fffffep-1f);
    const EmittedPhoton emitted = guidedEmission(world->tables, scene, uSelect, latticePoint2(lattice, index, 0),
                                                 latticePoint2(lattice, index, 2));
    if (record) *record = recordOf(&emitted, world->tables, scene);
    path.origin = offsetRayOrigin(emitted.position, emitted.normal, emitted.positionError);
    path.direction = emitted.direction;
    path.flux = emitted.flux / params->paths;
    path.referenceFlux = maxComponent(path.flux);
    path.events = 0;
    path.splits = 0;
    path.arrived = 0;
#ifdef MIXED_DIRECT
    path.direct = SCENE_TABLE(world->tables, scene, Emitter, emitters)[emitted.emitter].directByPhotons;
#endif
    path.depth = 0;
    path.steps = 0;
#ifdef HAS_MEDIA
    path.medium = SCENE_TABLE(world->tables, scene, Emitter, emitters)[emitted.emitter].medium;
    path.thinning = (uint)(u.y * 4294967296.f);
#endif
    countEnergy(count, ENERGY_EMITTED, meanFlux(path.flux));
    return path;
}

/* May the path go on? Counts why not. */
inline int photonMayGoOn(const PhotonPath* path, const PhotonParams* params, RegionCount* count) {
    if (path->referenceFlux == 0) return 0; /* a ray of another source of the guide */
    if (!all(isfinite(path->flux)) || !all(isfinite(path->direction))) {
        ++count->nonFinite;
        return 0;
    }
    if (path->depth >= params->maxDepth) {
        countEnergy(count, ENERGY_BEYOND_DEPTH, meanFlux(path->flux));
        return 0;
    }
    if (path->steps >= PATH_EVENTS_MAX) {
        ++count->cutPaths;
        count->fluxCut += meanFlux(path->flux);
        return 0;
    }
    return 1;
}

/* Is this class taken from photons of the path's emitter? */
inline int arrivalCounts(const PhotonPath* path, uint lightClass) {
#ifdef MIXED_DIRECT
    return lightClass != LIGHT_DIRECT || path->direct;
#else
    return 1;
#endif
}

/* Share of the photons that are stored where no importance path gathered any: hardly any path of the camera will, and sorting them takes time. */
#define UNSEEN_SHARE 0.125f

inline float storedShare(const PhotonWorld* world, const Surface* s) {
#if defined(LEARNS) && !defined(MAP_CAMERA)
    const ImportanceGrid* grid = &world->params->scene.learned.importance;
    return cameraGathers(world->tables, grid, s->position, importanceFace(s->geometricNormal)) ? 1.0f : UNSEEN_SHARE;
#else
    return 1;
#endif
}

/* A surface that the path has come to; 0 where it ends. `others` as applyWeightWindow has it. */
inline int meetSurface(PhotonPath* path, PhotonPath* others, Hit hit, const PhotonWorld* world, const PhotonSink* sink,
                       RegionCount* count) {
    const SceneTables* scene = &world->params->scene;
    const Surface s = surfaceAt(hit, path->origin, path->direction, world->blocks, world->tables, scene);
    __global const Shape* shape = SCENE_TABLE(world->tables, scene, Shape, shapes) + s.shape;
#ifdef HAS_MEDIA
    if (s.isNull) { /* the border of a medium that light passes freely */
        path->medium = mediumBeyond(shape, !s.front, path->medium);
        path->origin = leavingRay(&s, path->direction).origin;
        return 1;
    }
#endif
    ++path->depth;
    __global const Lobe* lobes = SCENE_TABLE(world->tables, scene, Lobe, lobes) + s.firstLobe;
    const uint lightClass = lawPhotonClass(path->events);
    const int delivered = path->arrived;
    path->arrived = 0;
    if (!delivered && storableClasses(lobes, s.lobeCount, world->params->scene.variant) & (1u << lightClass) &&
        arrivalCounts(path, lightClass)) {
        const float3 arriving = path->flux * shadingNormalArrival(&s);
        if (all(isfinite(arriving)) && NOTES_PATHS(world))
            learnArrival(count, world, s.position, importanceFace(s.geometricNormal), arriving, lightClass);
        else if (all(isfinite(arriving))) {
            const float share = storedShare(world, &s);
            if (share == 1 || rngNext(&path->rng) < share)
                deliverPhoton(sink, count, path, s.position, arriving / (PHOTON_RULE == 8 ? 1.0f : share),
                              s.patch << 1 | s.front, lightClass);
        } else
            ++count->nonFinite;
    }
    const float2 uDirection = rngNext2(&path->rng);
    const float3 u = (float3)(rngNext(&path->rng), uDirection.x, uDirection.y);
    const float arrived = meanFlux(path->flux);
    float scattered;
#ifdef LEARNS
    const uint cell =
        world->params->usualWorth > 0 || scene->learned.aimCount > 0
            ? scatteringCell(world->tables, &scene->learned.importance, s.position, importanceFace(s.geometricNormal))
            : QL_NONE;
    if (!delivered && !applyWeightWindow(path, others, cell, world, count)) return 0;
    const Aim aim = aimFrom(world->tables, scene, cell);
#else
    const Aim aim = {0, 0, 0, 0};
#endif
    const int goesOn = scatterPhoton(path, &s, lobes, shape, &aim,
                                     SCENE_TABLE(world->tables, &scene->learned, AimSource, aims), u, &scattered);
    countScattering(count, arrived, scattered, goesOn ? path->flux : (float3)(0));
    return goesOn;
}

/* One event of a path: to the next collision or surface, and what happens there; 0 where the path ends. */
inline int photonEvent(PhotonPath* path, PhotonPath* others, const PhotonWorld* world, const PhotonSink* sink,
                       RegionCount* count) {
    const SceneTables* scene = &world->params->scene;
    if (!photonMayGoOn(path, world->params, count)) return 0;
    ++path->steps;
    Hit hit;
    Ray ray;
    ray.origin = path->origin;
    ray.direction = path->direction;
    ray.tMin = 0;
    ray.tMax = INFINITY;
#ifdef HAS_MEDIA
    if (inMedium(path->medium)) {
        __global const Medium* medium = SCENE_TABLE(world->tables, scene, Medium, media) + path->medium;
        const MediumSegment segment = followMedium(medium, path->flux, &ray, 1, rngNext2(&path->rng), world->nodes,
                                                   world->blocks, world->tables, scene);
        crossMeter(path, segment.flight.distance, sink, world->tables, scene, count);
        const float before = meanFlux(path->flux);
        path->flux *= segment.flight.weight;
        countChance(count, before, meanFlux(path->flux));
        if (segment.flight.collided) {
            ++path->depth;
            return collidePhoton(path, segment.flight.distance, medium, sink, count, world);
        }
        hit = segment.hit;
    } else
#endif
    {
        if (path->arrived)
            hit = path->arrival;
        else {
            hit = intersectClosestOpaque(world->nodes, world->blocks, ray);
            crossMeter(path, hit.primitive == QL_NONE ? INFINITY : hit.t, sink, world->tables, scene, count);
        }
        path->arrival = hit;
    }
    if (hit.primitive == QL_NONE) {
        countEnergy(count, ENERGY_ESCAPED, meanFlux(path->flux));
        return 0;
    }
    return meetSurface(path, others, hit, world, sink, count);
}

/* Follows a path, and all that it is split into, to the end. */
inline void followPhoton(PhotonPath* path, const PhotonWorld* world, const PhotonSink* sink, RegionCount* count) {
    PhotonPath split[WINDOW_STACK + 1]; /* as they arrived where they were split */
    uint depth = 0;
    split[0].splits = 0;
    for (;;) {
#ifdef HAS_MEDIA
        PhotonPath* others = 0; /* they would fly through the medium before the surface anew */
#else
        PhotonPath* others = depth < WINDOW_STACK ? split + depth : 0;
#endif
        int goesOn = photonEvent(path, others, world, sink, count);
        if (split[depth].splits > 0) split[++depth].splits = 0;
        if (goesOn) continue;
        if (depth == 0) return;
        PhotonPath* next = split + depth - 1;
        next->rng.key = rngMix(next->rng.key + RNG_STEP * next->splits);
        *path = *next;
        if (--next->splits == 0) split[--depth].splits = 0;
    }
}

#ifdef WALK_ABREAST
/* Follows a path on its own until it may walk with the others; 0 where it ends before. Flux that is not finite would not
 * end in a walk. */
inline int joinWalk(PhotonPath* path, const Walkers* w, LaneMask walking, const PhotonWorld* world,
                    const PhotonSink* sink, RegionCount* count) {
    __global const Medium* media = SCENE_TABLE(world->tables, &world->params->scene, Medium, media);
    while (photonEvent(path, 0, world, sink, count))
        if (inMedium(path->medium) && mayWalk(media + path->medium) && (!walking || path->medium == w->medium) &&
            all(isfinite(path->flux)))
            return 1;
    return 0;
}

/* Paths `first` to `last` - 1: as many as walk at a time, each on its own where it does not. */
inline void walkPhotons(uint first, uint last, const Lattice* lattice, const PhotonWorld* world, const PhotonSink* sink,
                        RegionCount* count) {
    Walkers w;
    for (uint k = 0; k < WALKERS; ++k) w.paths[k] = idleWalker();
    LaneMask walking = 0, onTheirOwn = 0;
    for (;;) {
        for (uint k = 0; k < WALKERS; ++k) {
            const LaneMask bit = laneBit(k);
            if (walking & bit & ~onTheirOwn) continue;
            const int isNew = !(onTheirOwn & bit);
            walking &= ~bit;
            onTheirOwn &= ~bit;
            int joins = !isNew && joinWalk(&w.paths[k], &w, walking, world, sink, count);
            while (!joins && first < last) {
                w.paths[k] = emitPhoton(world, lattice, first++, count, 0);
                joins = joinWalk(&w.paths[k], &w, walking, world, sink, count);
            }
            if (!joins) continue;
            w.medium = w.paths[k].medium;
            walking |= bit;
        }
        if (!walking) return;
        onTheirOwn = walkAbreast(&w, &walking, world->tables, world->params, sink, count);
    }
}
#endif

#ifndef MAP_CAMERA
inline void notePath(const PhotonSink* sink, uint index, const EmissionRecord* emission, float flux,
                     const PhotonPath* path, const RegionCount* count) {
    PhotonRecord record = {*emission, flux, count->usefulSquares, path->steps};
    record.emission.weight = count->useful;
    ((__global PhotonRecord*)sink->store.arrays)[index] = record;
}
#endif

/* Paths one after the other. */
inline void followPhotons(uint first, uint last, const Lattice* lattice, const PhotonWorld* world,
                          const PhotonSink* sink, RegionCount* count) {
    for (uint index = first; index < last; ++index) {
        EmissionRecord emission;
        PhotonPath path = emitPhoton(world, lattice, index, count, NOTES_PATHS(world) ? &emission : 0);
        const float flux = meanFlux(path.flux) * world->params->paths;
        count->useful = count->usefulSquares = 0;
        followPhoton(&path, world, sink, count);
#ifndef MAP_CAMERA
        if (NOTES_PATHS(world)) notePath(sink, index, &emission, flux, &path, count);
#endif
    }
}

/* The paths of one region. */
inline void traceRegion(uint region, const PhotonWorld* world, const PhotonSink* sink, __global RegionCount* counts) {
    const PhotonParams* params = world->params;
    RegionCount count = {0};
    const Lattice lattice = latticeOfPass((ulong)params->seedHigh << 32 | params->seedLow, params->pass);
    const uint first = region * params->pathsPerRegion, last = min(first + params->pathsPerRegion, params->paths);
#ifdef WALK_ABREAST
    if (!NOTES_PATHS(world))
        walkPhotons(first, last, &lattice, world, sink, &count);
    else
#endif
        followPhotons(first, last, &lattice, world, sink, &count);
    counts[region] = count;
}

#ifdef MAP_CAMERA
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
#else
__kernel void tracePhotons(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global uint* photons, __global uint* photonBlocks,
                           __global RegionCount* counts, const PhotonParams params
#ifdef HAS_METER_PHOTONS
                           ,
                           __global uint* meterSums, const float quantaPerRadiance
#endif
) {
    const uint region = get_global_id(0);
    if (region >= params.regions) return;
    PhotonSink sink;
    const PhotonStore store = {photons, photonBlocks, params.photonBlocks, params.photonStride, params.perFluxUnit};
    sink.store = store;
#ifdef HAS_METER_PHOTONS
    sink.meter.sums = meterSums;
    sink.meter.quantaPerIrradiance = quantaPerRadiance * params.scene.meter.samples * M_1_PI_F;
#endif
    const PhotonWorld world = {nodes, blocks, tables, &params};
    traceRegion(region, &world, &sink, counts);
}
#endif
