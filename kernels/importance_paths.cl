/* Learning, step 1: paths from the camera to the emitters, which show where photons should begin and where they matter.
 * From: the camera. To: one ImportancePath each.
 *
 * An importance path scatters with all lobes and is never cut short by the map. From the vertex on where the camera
 * would gather diffuse photons, it is a photon's path backwards: what it finds at an emitter is emission that serves
 * the image. */
#include "camera.clh"
#include "camera_surface.clh"
#include "importance_light.clh"
#include "law.clh"
#include "medium_flight.clh"
#include "medium_place.clh"
#ifdef HAS_METER
#include "meter.clh"
#endif

#define IMPORTANCE_EVENTS_MAX 64u
/* Importance paths go on at most with this probability once they are past their first vertices. */
#define IMPORTANCE_SURVIVAL_MAX 0.9f

inline void storeVertex(ImportancePath* path, ImportanceState* state, float3 position, uint face) {
    if (state->vertices == IMPORTANCE_VERTICES) return;
    ImportanceVertex* vertex = path->vertices + state->vertices++;
    vertex->position.x = position.x;
    vertex->position.y = position.y;
    vertex->position.z = position.z;
    vertex->face = face;
    vertex->weight = meanOf(state->throughput);
}

inline void noteScattering(ImportanceState* state, uint scattering, uint bdd) {
    if (state->gathers)
        state->events |= scattering;
    else if (scattering == SCATTER_GENUINE_DIFFUSE && state->d++ == bdd)
        state->gathers = 1;
}

/* Goes straight on through a surface, on the same segment. */
inline void passImportance(const World* world, ImportanceState* state, const Surface* s, float distance) {
    state->ray = leavingRay(s, state->ray.direction);
    state->passed += max(distance, FLT_MIN);
    state->depth += PASSAGES_COUNT;
#ifdef HAS_MEDIA
    state->medium = mediumBeyond(SCENE_TABLE(world->tables, &world->params->scene, Shape, shapes) + s->shape, !s->front,
                                 state->medium);
#endif
}

/* Goes on with one lobe; 0 where the path ends. It has come `distance` from the last surface. */
inline int scatterImportance(const World* world, ImportanceState* state, const Surface* s, const Frame* frame,
                             float3 wo, __global const Lobe* lobes, const LobeChoice* choice, float distance) {
    float rest;
    const uint k = chooseLobe(choice, s->lobeCount, rngNext(&state->rng), &rest);
    if (k == s->lobeCount) return 0;
    const LobeSample sample = tintedSample(s, lobes, k, wo, rest, rngNext2(&state->rng), TRANSPORT_RADIANCE);
    if (!sample.valid) return 0;
    state->throughput *= sample.weight / choice->probability[k];
#ifdef HAS_PASSING_LOBE
    if (LOBE_PASSES(lobes[k].type)) {
        passImportance(world, state, s, distance);
        return 1;
    }
#endif
    const float3 wi = toWorld(frame, sample.wi);
    if (!sameSides(s, wi, sample.wi.z)) return 0;
    state->lobePdf = lobes[k].scattering == SCATTER_SPECULAR ? 0.f : choice->probability[k] * sample.pdfSolidAngle;
    noteScattering(state, lobes[k].scattering, world->params->bdd);
    state->ray = leavingRay(s, wi);
    state->hasScattered = 1;
    state->from = s->position;
    state->passed = 0;
#ifdef HAS_MEDIA
    if (sample.wi.z < 0)
        state->medium = mediumBeyond(SCENE_TABLE(world->tables, &world->params->scene, Shape, shapes) + s->shape,
                                     !s->front, state->medium);
#endif
    return 1;
}

/* As looksThroughEmitters of camera paths. */
inline int looksThrough(const ImportanceState* state) {
#ifdef HAS_HIDDEN_EMITTERS
    return !state->hasScattered;
#else
    return 0;
#endif
}

/* A surface that the path has come to; 0 where it ends. */
inline int meetImportanceSurface(const World* world, ImportancePath* path, ImportanceState* state, const Hit* hit) {
    const SceneTables* scene = &world->params->scene;
    const Surface s = surfaceAt(hit, state->ray.origin, state->ray.direction, world->blocks, world->tables, scene);
    __global const Shape* shape = SCENE_TABLE(world->tables, scene, Shape, shapes) + s.shape;
    int isHidden = 0;
#ifdef HAS_HIDDEN_EMITTERS
    isHidden = s.isHidden && looksThrough(state);
#endif
    if (s.emitter != QL_NONE && s.front && !isHidden)
        meetEmitter(world, path, state, s.emitter, (hit->primitive & PRIMITIVE_INDEX_MASK) - shape->firstPrimitive,
                    hit->t, s.geometricNormal, placeOf(&s), s.position);
    if (s.isNull || isHidden) {
        passImportance(world, state, &s, hit->t);
        return 1;
    }
    if (s.lobeCount == 0 || state->depth >= world->params->maxDepth) return 0;
    __global const Lobe* lobes = SCENE_TABLE(world->tables, scene, Lobe, lobes) + s.firstLobe;
    const Frame frame = shadingFrame(&s);
    const float3 wo = toLocal(&frame, -state->ray.direction);
    if (looksAway(&s, wo)) return 0;
    LobeChoice choice;
    const float brightest = maxComponent(state->throughput);
    uint kinds = 0;
    for (uint k = 0; k < s.lobeCount; ++k) {
        choice.probability[k] = maxComponent(state->throughput * tintedAlbedo(&s, lobes, k, wo)) / brightest;
        kinds |= lobes[k].scattering;
    }
    choiceFromStrengths(&choice, s.lobeCount, state->gathers ? 1 / IMPORTANCE_SURVIVAL_MAX : CAMERA_ROULETTE_THRESHOLD);
    if (!isPane(&s, lobes) && (state->gathers || (kinds & SCATTER_GENUINE_DIFFUSE && state->d == world->params->bdd)))
        storeVertex(path, state, s.position, importanceFace(s.geometricNormal));
    if (kinds != SCATTER_SPECULAR) sampleEmitterFor(world, path, state, &s, &frame, wo, lobes, &choice);
    return scatterImportance(world, state, &s, &frame, wo, lobes, &choice, hit->t);
}

#ifdef HAS_MEDIA
/* As sampleEmitterFor, at a collision; the path goes on with this probability. */
inline void sampleEmitterAtCollision(const World* world, ImportancePath* path, ImportanceState* state,
                                     __global const Medium* medium, float3 position, float survival) {
    const ImportanceLight sample = sampleImportanceLight(world, position, &state->rng);
    if (!sample.light.valid) return;
    const float p = phaseValue(medium, dot(state->ray.direction, sample.light.direction));
    const float share = sample.light.pdfSolidAngle > 0 ? shareOf(sample.light.pdfSolidAngle, survival * p) : 1.f;
    float ofPhotons = 0; /* part of the phase function whose light photons might bring */
    if (state->gathers)
        ofPhotons = p;
    else if (state->d == world->params->bdd)
        ofPhotons = phasePart(medium, SCATTER_GENUINE_DIFFUSE, p);
    const Ray shadow = {.origin = position, .tMin = 0, .direction = sample.light.direction};
    foundBySample(world, path, state, &sample, position, 0, shadow, share * ofPhotons * sample.light.radianceOverPdf,
                  share * (p - ofPhotons) * sample.light.radianceOverPdf);
}

/* A collision; 0 where the path ends. */
inline int collideImportance(const World* world, ImportancePath* path, ImportanceState* state, const FreeFlight* flight,
                             __global const Medium* medium) {
    if (state->depth >= world->params->maxDepth) return 0;
    const float before = maxComponent(state->throughput);
    const float3 position = state->ray.origin + flight->distance * state->ray.direction;
    state->throughput *= flight->weight * mediumAlbedo(medium, position);
    if (state->gathers || (medium->level > 0 && state->d == world->params->bdd))
        storeVertex(path, state, position, IMPORTANCE_FACE_MEDIUM);
    const float survival = min(IMPORTANCE_SURVIVAL_MAX, maxComponent(state->throughput) / before);
#ifdef HAS_DIRECT_IN_MEDIA
    sampleEmitterAtCollision(world, path, state, medium, position, survival);
#endif
    if (rngNext(&state->rng) >= survival) return 0;
    state->throughput /= survival;
    const PhaseSample sample = phaseSample(medium, state->ray.direction, 0, &state->rng);
    if (!sample.valid) return 0;
    state->throughput *= sample.weight;
    noteScattering(state, sample.scattering, world->params->bdd);
#ifdef HAS_DIRECT_IN_MEDIA
    state->lobePdf = survival * sample.p;
#else
    state->lobePdf = 0; /* no emitter is sampled at collisions */
#endif
    state->hasScattered = 1;
    state->ray.origin = state->from = position;
    state->ray.direction = sample.direction;
    state->ray.tMin = 0;
    state->ray.tMax = INFINITY;
    state->passed = 0;
    return 1;
}
#endif

/* One segment and what happens at its end; 0 where the path ends. */
inline int followImportancePath(const World* world, ImportancePath* path, ImportanceState* state) {
    const SceneTables* scene = &world->params->scene;
    if (state->passed == 0) ++state->depth;
    if (state->depth > world->params->maxDepth) return 0;
    Hit hit;
#ifdef HAS_MEDIA
    if (inMedium(state->medium)) {
        __global const Medium* medium = SCENE_TABLE(world->tables, scene, Medium, media) + state->medium;
        const MediumSegment segment = followMedium(medium, state->throughput, &state->ray, 0, rngNext2(&state->rng),
                                                   world->nodes, world->blocks, world->tables, scene);
        if (segment.flight.collided) return collideImportance(world, path, state, &segment.flight, medium);
        state->throughput *= segment.flight.weight;
        hit = segment.hit;
    } else
#endif
        hit = intersectClosest(world->nodes, world->blocks, &state->ray);
    if (hit.primitive != QL_NONE) return meetImportanceSurface(world, path, state, &hit);
    __global const Emitter* emitters = SCENE_TABLE(world->tables, scene, Emitter, emitters);
    const uint surroundings = emitterOfSurroundings(emitters, scene->emitterCount);
    if (surroundings != QL_NONE && !looksThrough(state))
        meetEmitter(world, path, state, surroundings, 0, INFINITY, -state->ray.direction, texturePointOf(0),
                    state->ray.origin);
    return 0;
}

inline Ray importanceRay(const Camera* camera, __global const uint* tables, uint pixel, Rng* rng) {
    const FilterPlace place = filterPlace(camera, tables, pixel, rngNext2(rng));
#ifdef HAS_THIN_LENS
    const float2 lens = rngNext2(rng);
#else
    const float2 lens = 0;
#endif
    Ray ray = cameraRay(camera, pixel, place.offset, lens);
    beginOnNearPlane(&ray);
    return ray;
}

__kernel void traceImportancePaths(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                                   __global const uint* tables, __global ImportancePath* paths,
                                   const CameraParams params, const uint count) {
    const uint index = get_global_id(0);
    if (index >= count) return;
    const World world = {.nodes = nodes, .blocks = blocks, .tables = tables, .params = &params};
    const uint pixels = params.camera.width * params.camera.height;
    const uint pixel = pixels > count ? (uint)((ulong)index * pixels / count) : index % pixels;
    ImportancePath path;
    path.indirect.emitter = path.direct.emitter = QL_NONE;
    path.indirect.weight = path.direct.weight = 0;
    path.indirect.inverseDensity = path.direct.inverseDensity = 0;
    path.radiance = path.gatheredShare = path.laterProbability = 0;
    path.pixel = path.indirect.pixel = path.direct.pixel = pixel;
    for (uint k = 0; k < IMPORTANCE_VERTICES; ++k) path.vertices[k].weight = path.vertices[k].found = 0;
    ImportanceState state;
    state.rng = rngMake((ulong)params.seedHigh << 32 | params.seedLow, 0, STREAM_IMPORTANCE, index);
    state.throughput = 1;
    state.d = state.events = state.vertices = state.depth = 0;
    state.gathers = 0;
    state.lobePdf = state.passed = 0;
    state.hasScattered = 0;
#ifdef HAS_IRRADIANCE_METER
    const MeterPlace place = meterPlace(&params.scene.meter, tables, pixel, rngNext2(&state.rng));
    const Surface s = meterSurfaceOf(&params.scene, tables, &place);
    const Frame frame = frameFromNormal(s.geometricNormal);
    state.ray = leavingRay(&s, toWorld(&frame, sampleCosineHemisphere(rngNext2(&state.rng))));
    state.gathers = 1;
    state.events = SCATTER_GENUINE_DIFFUSE; /* what it has from emitters is no image of them */
#else
    state.ray = importanceRay(&params.camera, tables, pixel, &state.rng);
#endif
#ifdef HAS_IRRADIANCE_METER
    const uint medium = place.medium;
#else
    const uint medium = params.camera.medium;
#endif
#ifdef HAS_MEDIA
    state.medium = mediumAtOrigin(medium, state.ray.origin, state.ray.direction, nodes, blocks, tables, &params.scene);
#else
    state.medium = medium;
#endif
    state.from = state.ray.origin;
    uint event = isBeyondImage(&state.ray) ? IMPORTANCE_EVENTS_MAX : 0;
    while (event < IMPORTANCE_EVENTS_MAX && followImportancePath(&world, &path, &state)) ++event;
    paths[index] = path;
}
