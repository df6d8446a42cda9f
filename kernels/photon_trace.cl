/* Stage 1 of a pass: trace photons from the emitters and store them by class.
 * From: emitters. To: photons in regions, in the order of their paths (so the result does not depend on scheduling). */
#include "emitter.clh"
#include "lattice.clh"
#include "law.clh"
#include "scatter.clh"

/* Photon paths go on for sure down to this share of their first flux; below, roulette ends them in proportion. On the
 * Cornell box 0.5 reaches the same error in the same time, with twice the photons to keep. */
#define PHOTON_ROULETTE_THRESHOLD 1.0f

typedef struct {
    float3 origin, direction; /* current segment */
    float3 flux;
    float referenceFlux; /* largest channel at emission, scale of the roulette */
    uint events;         /* union of SCATTER_* so far */
    uint depth;          /* segments */
} PhotonPath;

inline void storePhoton(__global Photon* photons, RegionCount* count, uint capacity, const PhotonPath* path,
                        const Surface* s, uint lightClass) {
    if (count->wanted++ >= capacity) return;
    __global Photon* p = photons + count->stored++;
    p->position.x = s->position.x;
    p->position.y = s->position.y;
    p->position.z = s->position.z;
    p->direction = encodeOctahedral(-path->direction);
    p->flux.r = path->flux.x;
    p->flux.g = path->flux.y;
    p->flux.b = path->flux.z;
    p->patchSide = s->patch << 1 | s->front;
    p->classDepth = min(path->depth, PHOTON_DEPTH_MAX) << 2 | lightClass;
}

/* Classes of light that the lobes met here can ever take, restricted to those the kernels store. */
inline uint storableClasses(__global const Lobe* lobes, uint count) {
    uint classes = 0;
    for (uint k = 0; k < count; ++k) classes |= lawLightPossible(lobes[k].scattering);
    return classes & PHOTON_CLASSES;
}

/* Flux reflected by a shading normal that disagrees with the geometry (Veach 1997, eq. 5.19):
 * |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|), where wo points to the light side that the photon came from. */
inline float shadingNormalCorrection(const Surface* s, float3 wo, float3 wi) {
#ifdef HAS_CORNER_NORMALS
    const float denominator = dot(wo, s->geometricNormal) * dot(wi, s->shadingNormal);
    return denominator == 0 ? 0.f : fabs(dot(wo, s->shadingNormal) * dot(wi, s->geometricNormal) / denominator);
#else
    return 1.f;
#endif
}

/* Scatters the photon with one lobe; 0 where it ends. */
inline int scatterPhoton(PhotonPath* path, const Surface* s, __global const Lobe* lobes, float3 u) {
    const Frame frame = frameFromNormal(s->shadingNormal);
    const float3 wo = toLocal(&frame, -path->direction);
    LobeChoice choice;
    for (uint k = 0; k < s->lobeCount; ++k)
        choice.probability[k] = maxComponent(path->flux * tintedAlbedo(s, lobes, k, wo)) / path->referenceFlux;
    choiceFromStrengths(&choice, s->lobeCount, PHOTON_ROULETTE_THRESHOLD);
    float rest;
    const uint k = chooseLobe(&choice, s->lobeCount, u.x, &rest);
    if (k == s->lobeCount) return 0;
    const LobeSample sample = tintedSample(s, lobes, k, wo, rest, u.yz, TRANSPORT_FLUX);
    if (!sample.valid) return 0;
    const float3 wi = toWorld(&frame, sample.wi);
    if (!sameSides(s, wi, sample.wi.z)) return 0;
    path->flux *= sample.weight * (shadingNormalCorrection(s, -path->direction, wi) / choice.probability[k]);
    path->events |= lobes[k].scattering;
    path->direction = wi;
    const Ray ray = leavingRay(s, wi);
    path->origin = ray.origin;
    return 1;
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
    const float extent = sqrt(SCENE_TABLE(tables, scene, Emitter, emitters)[emitted.emitter].area);
    path.origin = offsetRayOrigin(emitted.position, emitted.normal,
                                  POSITION_ERROR * (maxMagnitude(emitted.position) + 2 * extent));
    path.direction = emitted.direction;
    path.flux = emitted.flux / params->paths;
    path.referenceFlux = maxComponent(path.flux);
    path.events = 0;
    path.depth = 0;
    return path;
}

inline void tracePhotonPath(uint index, const Lattice* lattice, __global const BvhNode* nodes,
                            __global const PrimitiveBlock* blocks, __global const uint* tables,
                            __global Photon* photons, const PhotonParams* params, RegionCount* count) {
    const SceneTables* scene = &params->scene;
    const ulong seed = (ulong)params->seedHigh << 32 | params->seedLow;
    Rng rng = rngMake(seed, params->pass, STREAM_PHOTON, index);
    PhotonPath path = emitPhoton(tables, params, lattice, index, &rng);
    for (uint event = 0; event < PATH_EVENTS_MAX; ++event) {
        if (!all(isfinite(path.flux)) || !all(isfinite(path.direction))) {
            ++count->nonFinite;
            return;
        }
        if (path.depth >= params->maxDepth) return;
        Ray ray;
        ray.origin = path.origin;
        ray.direction = path.direction;
        ray.tMin = 0;
        ray.tMax = INFINITY;
        const Hit hit = intersectClosestOpaque(nodes, blocks, ray);
        if (hit.primitive == QL_NONE) return;
        ++path.depth;
        const Surface s = surfaceAt(hit, path.origin, path.direction, blocks, tables, scene);
        __global const Lobe* lobes = SCENE_TABLE(tables, scene, Lobe, lobes) + s.firstLobe;
        const uint lightClass = lawPhotonClass(path.events);
        if (storableClasses(lobes, s.lobeCount) & (1u << lightClass))
            storePhoton(photons, count, params->regionCapacity, &path, &s, lightClass);
        const float2 uDirection = rngNext2(&rng);
        const float3 u = (float3)(rngNext(&rng), uDirection.x, uDirection.y);
        if (!scatterPhoton(&path, &s, lobes, u)) return;
    }
    ++count->cutPaths;
    count->fluxCut += (path.flux.x + path.flux.y + path.flux.z) / 3;
}

/* One work-item: the paths of one region. */
__kernel void tracePhotons(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                           __global const uint* tables, __global Photon* photons, __global RegionCount* counts,
                           const PhotonParams params) {
    const uint region = get_global_id(0);
    if (region >= params.regions) return;
    RegionCount count = {0, 0, 0, 0, 0};
    const Lattice lattice = latticeOfPass((ulong)params.seedHigh << 32 | params.seedLow, params.pass);
    const uint first = region * params.pathsPerRegion;
    const uint last = min(first + params.pathsPerRegion, params.paths);
    for (uint index = first; index < last; ++index)
        tracePhotonPath(index, &lattice, nodes, blocks, tables, photons + (size_t)region * params.regionCapacity,
                        &params, &count);
    counts[region] = count;
}
