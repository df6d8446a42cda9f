/* Stage 1 of a pass: trace photons from the emitters and store them by class.
 * From: emitters. To: photons in regions, in the order of their paths (so the result does not depend on scheduling).
 * With MAP_CAMERA it is stage 3 and stores nothing: photons are splatted to camera points. To: sums of splats. */
#include "emitter.clh"
#include "energy_balance.clh"
#include "lattice.clh"
#include "law.clh"
#include "medium_flight.clh"
#include "scatter.clh"
#include "splat_sums.clh"
#ifdef MAP_CAMERA
#include "splat.clh"
#endif
#ifdef HAS_METER_PHOTONS
#include "meter_photons.clh"
#endif

/* Photon paths go on for sure down to this share of their first flux; below, roulette ends them in proportion. On the
 * Cornell box 0.5 reaches the same error in the same time, with twice the photons to keep. */
#define PHOTON_ROULETTE_THRESHOLD 1.0f

typedef struct {
    float3 origin, direction; /* current segment */
    float3 flux;
    float referenceFlux; /* largest channel at emission, scale of the roulette */
    uint events;         /* union of SCATTER_* so far */
    uint depth;          /* segments */
#ifdef HAS_MEDIA
    uint medium; /* index or MEDIUM_NONE */
#endif
} PhotonPath;

/* What becomes of a photon where it arrives: `place` and `slot` as in Photon. */
#ifdef MAP_CAMERA
typedef SplatTarget PhotonSink;

#ifdef HAS_METER_PHOTONS
inline MeterSums meterSumsOf(const PhotonSink* target) {
    const MeterSums sums = {target->sums, target->quantaPerRadiance * target->scene->meter.samples * M_1_PI_F};
    return sums;
}
#endif

inline void deliverPhoton(const PhotonSink* target, RegionCount* count, const PhotonPath* path, float3 position,
                          float3 flux, uint place, uint slot) {
    ++count->wanted;
    const ArrivedPhoton photon = {position, path->direction, flux, min(path->depth, PHOTON_DEPTH_MAX), place, slot};
    splatPhoton(target, &photon, count);
}
#else
/* A region's own part of the photon buffer. */
typedef struct {
    __global Photon* photons;
    uint capacity;
#ifdef HAS_METER_PHOTONS
    MeterSums meter;
#endif
} PhotonSink;

#ifdef HAS_METER_PHOTONS
inline MeterSums meterSumsOf(const PhotonSink* sink) { return sink->meter; }
#endif

inline void deliverPhoton(const PhotonSink* sink, RegionCount* count, const PhotonPath* path, float3 position,
                          float3 flux, uint place, uint slot) {
    if (count->wanted++ >= sink->capacity) return;
    __global Photon* p = sink->photons + count->stored++;
    p->position.x = position.x;
    p->position.y = position.y;
    p->position.z = position.z;
    p->direction = encodeOctahedral(-path->direction);
    p->flux.r = flux.x;
    p->flux.g = flux.y;
    p->flux.b = flux.z;
    p->patchSide = place;
    p->classDepth = min(path->depth, PHOTON_DEPTH_MAX) << 3 | slot;
}
#endif

/* Classes of light that the lobes met here can ever take, restricted to those the kernels store. */
inline uint storableClasses(__global const Lobe* lobes, uint count) {
    uint classes = 0;
    for (uint k = 0; k < count; ++k) classes |= lawLightPossible(lobes[k].scattering);
    return classes & PHOTON_CLASSES;
}

/* Flux reflected by a shading normal that disagrees with the geometry (Veach 1997, eq. 5.19):
 * |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|), where wo points to the light side that the photon came from. */
inline float shadingNormalCorrection(const Surface* s, float3 wo, float3 wi) {
#if defined(HAS_CORNER_NORMALS) && PHOTON_RULE != 3
    const float denominator = dot(wo, s->geometricNormal) * dot(wi, s->shadingNormal);
    return denominator == 0 ? 0.f : fabs(dot(wo, s->shadingNormal) * dot(wi, s->geometricNormal) / denominator);
#else
    return 1.f;
#endif
}

/* Factor on flux that is stored: photons arrive in proportion to |wi.ng|, and light is reflected in proportion to
 * |wi.ns|, none of it from below the horizon of the shading normal. */
inline float shadingNormalArrival(const Surface* s) {
#if defined(HAS_CORNER_NORMALS) && PHOTON_RULE != 4
    return s->arrival;
#else
    return 1.f;
#endif
}

/* Scatters the photon with one lobe; 0 where it ends. *scattered is the flux that all lobes reflect in expectation. */
inline int scatterPhoton(PhotonPath* path, const Surface* s, __global const Lobe* lobes, __global const Shape* shape,
                         float3 u, float* scattered) {
    const Frame frame = frameFromNormal(s->shadingNormal);
    const float3 wo = toLocal(&frame, -path->direction);
    LobeChoice choice;
    *scattered = 0;
    for (uint k = 0; k < s->lobeCount; ++k) {
        const float3 flux = path->flux * tintedAlbedo(s, lobes, k, wo);
        choice.probability[k] = maxComponent(flux) / path->referenceFlux;
#ifdef ENERGY_BALANCE
        *scattered += meanFlux(flux);
#endif
    }
    choiceFromStrengths(&choice, s->lobeCount, PHOTON_ROULETTE_THRESHOLD);
    float rest;
    const uint k = chooseLobe(&choice, s->lobeCount, u.x, &rest);
    if (k == s->lobeCount) return 0;
    const LobeSample sample = tintedSample(s, lobes, k, wo, rest, u.yz, TRANSPORT_FLUX);
    if (!sample.valid) return 0;
    const float3 wi = toWorld(&frame, sample.wi);
    if (!sameSides(s, wi, sample.wi.z)) return 0;
    path->flux *= sample.weight * (shadingNormalCorrection(s, -path->direction, wi) / choice.probability[k]);
    if (PHOTON_RULE == 2) path->flux *= 1.02f;
    path->events |= lobes[k].scattering;
    path->direction = wi;
    const Ray ray = leavingRay(s, wi);
    path->origin = ray.origin;
#ifdef HAS_MEDIA
    if (sample.wi.z < 0) path->medium = mediumBeyond(shape, !s->front, path->medium);
#endif
    return 1;
}

#ifdef HAS_MEDIA
/* A collision in the medium that the path is in: delivers the photon, thinned, and scatters it; 0 where it ends. */
inline int collidePhoton(PhotonPath* path, const FreeFlight* flight, __global const Medium* medium,
                         const PhotonSink* sink, RegionCount* count, const PhotonParams* params, Rng* rng) {
    path->origin += flight->distance * path->direction;
    const uint slot = VOLUME_SLOT(lawPhotonClass(path->events));
    uint possible = 0;
    const uint scatterings = phaseScatterings(medium);
    if (scatterings & SCATTER_GENUINE_DIFFUSE) possible |= lawLightPossible(SCATTER_GENUINE_DIFFUSE);
    if (scatterings & SCATTER_QUASI_SPECULAR) possible |= lawLightPossible(SCATTER_QUASI_SPECULAR);
    if ((possible << LIGHT_CLASSES & PHOTON_CLASSES) >> slot & 1) {
        const float keep = params->keepProbability[slot - LIGHT_CLASSES];
        if (rngNext(rng) < keep)
            deliverPhoton(sink, count, path, path->origin, path->flux * inverseExtinction(medium) / keep, path->medium,
                          slot);
    }
    const float arrived = meanFlux(path->flux);
    path->flux *= loadRgb(medium->albedo);
    const float scattered = meanFlux(path->flux);
    const float strength = maxComponent(path->flux) / path->referenceFlux;
    const float survival = min(1.f, strength / PHOTON_ROULETTE_THRESHOLD);
    const int goesOn = rngNext(rng) < survival;
    path->flux /= survival;
    countScattering(count, arrived, scattered, goesOn ? path->flux : (float3)(0));
    if (!goesOn) return 0;
    const float3 before = path->direction;
    path->direction = phaseSampleDirection(medium, before, rngNext2(rng));
    path->events |= phaseEvent(medium, phaseValue(medium, dot(before, path->direction)), rngNext(rng));
    return 1;
}
#endif

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

inline PhotonPath emitPhoton(__global const uint* tables, const PhotonParams* params, const Lattice* lattice,
                             uint index, Rng* rng) {
    const SceneTables* scene = &params->scene;
    /* Emitters are chosen by stratified numbers, so each gets its share of every pass. */
    const float uSelect = min((index + rngNext(rng)) / params->paths, 0x1.fffffep-1f);
    const EmittedPhoton emitted = emitterSampleEmission(
        SCENE_TABLE(tables, scene, Emitter, emitters), SCENE_TABLE(tables, scene, EmitterTriangle, emitterTriangles),
        scene->emitterCount, uSelect, latticePoint2(lattice, index, 0), latticePoint2(lattice, index, 2));
    PhotonPath path;
    path.origin = offsetRayOrigin(emitted.position, emitted.normal, emitted.positionError);
    path.direction = emitted.direction;
    path.flux = emitted.flux / params->paths;
    path.referenceFlux = maxComponent(path.flux);
    path.events = 0;
    path.depth = 0;
#ifdef HAS_MEDIA
    path.medium = SCENE_TABLE(tables, scene, Emitter, emitters)[emitted.emitter].medium;
#endif
    return path;
}

inline void tracePhotonPath(uint index, const Lattice* lattice, __global const BvhNode* nodes,
                            __global const PrimitiveBlock* blocks, __global const uint* tables, const PhotonSink* sink,
                            const PhotonParams* params, RegionCount* count) {
    const SceneTables* scene = &params->scene;
    const ulong seed = (ulong)params->seedHigh << 32 | params->seedLow;
    Rng rng = rngMake(seed, params->pass, STREAM_PHOTON, index);
    PhotonPath path = emitPhoton(tables, params, lattice, index, &rng);
    countEnergy(count, ENERGY_EMITTED, meanFlux(path.flux));
    for (uint event = 0; event < PATH_EVENTS_MAX; ++event) {
        if (!all(isfinite(path.flux)) || !all(isfinite(path.direction))) {
            ++count->nonFinite;
            return;
        }
        if (path.depth >= params->maxDepth) {
            countEnergy(count, ENERGY_BEYOND_DEPTH, meanFlux(path.flux));
            return;
        }
        Hit hit;
        Ray ray;
        ray.origin = path.origin;
        ray.direction = path.direction;
        ray.tMin = 0;
        ray.tMax = INFINITY;
#ifdef HAS_MEDIA
        if (inMedium(path.medium)) {
            __global const Medium* medium = SCENE_TABLE(tables, scene, Medium, media) + path.medium;
            const MediumSegment segment =
                followMedium(medium, path.flux, &ray, 1, rngNext2(&rng), nodes, blocks, tables, scene);
            crossMeter(&path, segment.flight.distance, sink, tables, scene, count);
            const float before = meanFlux(path.flux);
            path.flux *= segment.flight.weight;
            countChance(count, before, meanFlux(path.flux));
            if (segment.flight.collided) {
                ++path.depth;
                if (!collidePhoton(&path, &segment.flight, medium, sink, count, params, &rng)) return;
                continue;
            }
            hit = segment.hit;
        } else
#endif
        {
            hit = intersectClosestOpaque(nodes, blocks, ray);
            crossMeter(&path, hit.primitive == QL_NONE ? INFINITY : hit.t, sink, tables, scene, count);
        }
        if (hit.primitive == QL_NONE) {
            countEnergy(count, ENERGY_ESCAPED, meanFlux(path.flux));
            return;
        }
        const Surface s = surfaceAt(hit, path.origin, path.direction, blocks, tables, scene);
        __global const Shape* shape = SCENE_TABLE(tables, scene, Shape, shapes) + s.shape;
#ifdef HAS_MEDIA
        if (s.isNull) { /* the border of a medium that light passes freely */
            path.medium = mediumBeyond(shape, !s.front, path.medium);
            path.origin = leavingRay(&s, path.direction).origin;
            continue;
        }
#endif
        ++path.depth;
        __global const Lobe* lobes = SCENE_TABLE(tables, scene, Lobe, lobes) + s.firstLobe;
        const uint lightClass = lawPhotonClass(path.events);
        if (storableClasses(lobes, s.lobeCount) & (1u << lightClass))
            deliverPhoton(sink, count, &path, s.position, path.flux * shadingNormalArrival(&s), s.patch << 1 | s.front,
                          lightClass);
        const float2 uDirection = rngNext2(&rng);
        const float3 u = (float3)(rngNext(&rng), uDirection.x, uDirection.y);
        const float arrived = meanFlux(path.flux);
        float scattered;
        const int goesOn = scatterPhoton(&path, &s, lobes, shape, u, &scattered);
        countScattering(count, arrived, scattered, goesOn ? path.flux : (float3)(0));
        if (!goesOn) return;
    }
    ++count->cutPaths;
    count->fluxCut += meanFlux(path.flux);
}

/* The paths of one region. */
inline void traceRegion(uint region, __global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                        __global const uint* tables, const PhotonSink* sink, const PhotonParams* params,
                        __global RegionCount* counts) {
    RegionCount count = {0, 0, 0, 0, 0, 0, 0, {0}, {0}};
    const Lattice lattice = latticeOfPass((ulong)params->seedHigh << 32 | params->seedLow, params->pass);
    const uint first = region * params->pathsPerRegion;
    const uint last = min(first + params->pathsPerRegion, params->paths);
    for (uint index = first; index < last; ++index)
        tracePhotonPath(index, &lattice, nodes, blocks, tables, sink, params, &count);
    counts[region] = count;
}

#ifdef MAP_CAMERA
__kernel void splatPhotons(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global const uint* cellStart, __global const uint* sorted,
                           __global const CameraPoint* points, __global const PointBorder* borders, __global uint* sums,
                           __global RegionCount* counts, const PhotonParams params, const PointParams store) {
    const uint region = get_global_id(0);
    if (region >= params.regions) return;
    const SplatTarget target = {{sorted, cellStart, &store.map}, points, borders, sums, tables, &params.scene,
                                store.quantaPerRadiance};
    traceRegion(region, nodes, blocks, tables, &target, &params, counts);
}
#else
__kernel void tracePhotons(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global Photon* photons, __global RegionCount* counts,
                           const PhotonParams params
#ifdef HAS_METER_PHOTONS
                           ,
                           __global uint* meterSums, const float quantaPerRadiance
#endif
) {
    const uint region = get_global_id(0);
    if (region >= params.regions) return;
    PhotonSink sink;
    sink.photons = photons + (size_t)region * params.regionCapacity;
    sink.capacity = params.regionCapacity;
#ifdef HAS_METER_PHOTONS
    sink.meter.sums = meterSums;
    sink.meter.quantaPerIrradiance = quantaPerRadiance * params.scene.meter.samples * M_1_PI_F;
#endif
    traceRegion(region, nodes, blocks, tables, &sink, &params, counts);
}
#endif
