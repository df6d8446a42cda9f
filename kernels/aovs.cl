/* What the rays of a pixel meet first, as integrator 'aov' of Mitsuba shows it: distances, places, normals,
 * reflectance. Means over samples, seen through the same filter as the image; where a ray meets nothing, it adds
 * nothing. From: camera rays. To: AOV_FLOATS for each pixel of the part that the launch traces. Option: HAS_UV_LAYERS. */
#include "aov_types.h"
#include "camera.clh"
#include "medium_place.clh"
#include "tinted_lobe.clh"

/* Is the lobe the gloss of a coat, whose base counts alone? Metals have an absorption, or no index at all. */
inline int isGlossOfCoat(__global const Lobe* lobe) {
    return (lobe->type == LOBE_GGX || lobe->type == LOBE_BECKMANN) && !any(loadRgb(lobe->k) > 0) &&
           any(loadRgb(lobe->eta) > 0);
}

/* Reflectance of a lobe as Mitsuba's bsdfs state it: that of the base under a coat, of `principled` the base colour,
 * of which metal has a share too. Other lobes count by pi f for light that leaves along the normal, which may be above
 * 1. */
inline float3 lobeReflectance(const Surface* s, __global const Lobe* lobes, uint k, float3 wo) {
    __global const Lobe* lobe = lobes + k;
    const float3 reflectance = loadRgb(lobe->reflectance);
    switch (lobe->type) {
    case LOBE_LAMBERT:
    case LOBE_PRINCIPLEDDIFFUSE:
        return tinted(s, k, reflectance);
    case LOBE_COATEDLAMBERT:
    case LOBE_ROUGHCOATEDLAMBERT: /* the coat's own factors are taken out again */
        return tinted(s, k, reflectance * lobe->exponent);
    case LOBE_GGXSCHLICK:
        return tinted(s, k, reflectance * loadRgb(lobe->eta));
#ifdef HAS_TRANSMITTED_TINT
    case LOBE_DIFFUSETRANSMISSION:
    case LOBE_THINGGX:
        return s->transmittedTint[k] * loadRgb(lobe->transmittance);
#else
    case LOBE_DIFFUSETRANSMISSION:
    case LOBE_THINGGX:
        return tinted(s, k, loadRgb(lobe->transmittance));
#endif
    case LOBE_SHEEN:
    case LOBE_CLEARCOAT:
        return 0;
    }
    if (lobe->scattering == SCATTER_SPECULAR || isGlossOfCoat(lobe)) return 0;
    return M_PI_F * tintedEval(s, lobes, k, wo, (float3)(0, 0, 1));
}

inline float3 diffuseReflectance(const Surface* s, __global const Lobe* lobes, float3 wo) {
    float3 sum = 0;
    for (uint k = 0; k < s->lobeCount; ++k) sum += lobeReflectance(s, lobes, k, wo);
    return sum;
}

#ifdef HAS_UV_LAYERS
#define AOV_FLOATS AOV_ALL_FLOATS
#else
#define AOV_FLOATS AOV_PLAIN_FLOATS
#endif

inline void addTriple(float* sums, float3 value) { vstore3(vload3(0, sums) + value, 0, sums); }

#ifdef HAS_UV_LAYERS
inline void addPair(float* sums, float2 value) { vstore2(vload2(0, sums) + value, 0, sums); }

/* Change of the texture coordinates from where the surface was met to where the ray `beside` meets its tangent
 * plane. */
inline float2 uvStep(const Surface* s, const Ray* beside) {
    const float distance = dot(s->position - beside->origin, s->geometricNormal);
    const float3 step =
        beside->origin - s->position + distance / dot(beside->direction, s->geometricNormal) * beside->direction;
    const float3 u = s->tangents.u, v = s->tangents.v;
    const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), alongU = dot(u, step), alongV = dot(v, step);
    const float determinant = uu * vv - uv * uv;
    return determinant > 0 ? (float2)(vv * alongU - uv * alongV, uu * alongV - uv * alongU) / determinant : 0;
}

/* `besideX`, `besideY`: rays of the places one pixel to the right and one down. */
inline void addUvAovs(float* sums, const Surface* s, float weight, const Ray* besideX, const Ray* besideY) {
    addPair(sums + AOV_UV, weight * s->uv);
    addTriple(sums + AOV_DP_DU, weight * s->tangents.u);
    addTriple(sums + AOV_DP_DV, weight * s->tangents.v);
    addPair(sums + AOV_DUV_DX, weight * uvStep(s, besideX));
    addPair(sums + AOV_DUV_DY, weight * uvStep(s, besideY));
}
#endif

inline Surface addAovs(float* sums, const Ray* ray, const Hit* hit, float weight, __global const PrimitiveBlock* blocks,
                       __global const uint* tables, const SceneTables* scene) {
    const Surface s = surfaceAt(hit, ray->origin, ray->direction, blocks, tables, scene);
    __global const Lobe* lobes = SCENE_TABLE(tables, scene, Lobe, lobes) + s.firstLobe;
    const Frame frame = shadingFrame(&s);
    const float side = s.front ? weight : -weight; /* normals are those of the surface, on whatever side it is met */
    addTriple(sums + AOV_ALBEDO, weight * diffuseReflectance(&s, lobes, toLocal(&frame, -ray->direction)));
    addTriple(sums + AOV_POSITION, weight * s.position);
    addTriple(sums + AOV_GEO_NORMAL, side * s.geometricNormal);
    addTriple(sums + AOV_SH_NORMAL, side * s.shadingNormal);
    sums[AOV_DEPTH] += weight * (hit->t - ray->tMin); /* from the near clipping plane */
    const uint first = SCENE_TABLE(tables, scene, Shape, shapes)[s.shape].firstPrimitive;
    sums[AOV_PRIM_INDEX] += weight * (float)((hit->primitive & PRIMITIVE_INDEX_MASK) - first);
    sums[AOV_SHAPE_INDEX] += weight * (float)(s.shape + 1);
    sums[AOV_COVERAGE] += weight;
    return s;
}

/* Does the camera look through the emitter on this surface? */
inline int isHiddenEmitter(const Surface* s) {
#ifdef HAS_HIDDEN_EMITTERS
    return s->isHidden;
#else
    return 0;
#endif
}

/* Share of what comes from far behind along the ray that gets past the surface. */
inline float3 passedBySurface(const Surface* s, float3 direction, __global const uint* tables,
                              const SceneTables* scene) {
    if (s->isNull || isHiddenEmitter(s)) return 1;
#ifdef HAS_PASSING_LOBE
    __global const Lobe* lobes = SCENE_TABLE(tables, scene, Lobe, lobes) + s->firstLobe;
    return passedShare(s, lobes, -dot(direction, s->shadingNormal));
#else
    return 0;
#endif
}

/* Opacity of what the ray meets, mean of R, G and B: 1 less the light from far behind that comes straight through `null`
 * surfaces, masks, panes and media. `medium`: as the camera states it. */
inline float opacityAlong(Ray ray, uint medium, __global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                          __global const uint* tables, const SceneTables* scene) {
    float3 passed = 1;
#ifdef HAS_MEDIA
    beginOnNearPlane(&ray);
    medium = mediumAtOrigin(medium, ray.origin, ray.direction, nodes, blocks, tables, scene);
#endif
    for (uint event = 0; event < PATH_EVENTS_MAX && any(passed > 0); ++event) {
        const Hit hit = intersectClosest(nodes, blocks, &ray);
#ifdef HAS_MEDIA
        if (inMedium(medium))
            passed *= segmentTransmittance(SCENE_TABLE(tables, scene, Medium, media) + medium, ray.origin,
                                           ray.direction, min(hit.t, ray.tMax));
#endif
        if (hit.primitive == QL_NONE) break;
        const Surface s = surfaceAt(&hit, ray.origin, ray.direction, blocks, tables, scene);
        passed *= passedBySurface(&s, ray.direction, tables, scene);
#ifdef HAS_MEDIA
        medium = mediumBeyond(SCENE_TABLE(tables, scene, Shape, shapes) + s.shape, !s.front, medium);
#endif
        const float rest = ray.tMax - hit.t;
        ray = leavingRay(&s, ray.direction);
        ray.tMax = rest;
    }
    return 1 - (passed.x + passed.y + passed.z) / 3;
}

__kernel void traceAovs(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                        __global const uint* tables, __global float* aovs, const CameraParams params,
                        const uint samples) {
    const uint place = get_global_id(0);
    if (place >= params.pixels) return;
    const uint pixel = params.firstPixel + place;
    const Camera* camera = &params.camera;
    const ulong seed = (ulong)params.seedHigh << 32 | params.seedLow;
    float sums[AOV_FLOATS];
    for (uint k = 0; k < AOV_FLOATS; ++k) sums[k] = 0;
    for (uint sample = 0; sample < samples; ++sample) {
        const FilterPlace place = filterPlace(camera, tables, pixel, pixelPlace(pixel, sample, seed));
        const float2 lens = lensNumbers(pixel, sample, seed);
        const Ray ray = cameraRay(camera, pixel, place.offset, lens);
        if (isBeyondImage(&ray)) continue;
        sums[AOV_ALPHA] += place.weight * opacityAlong(ray, camera->medium, nodes, blocks, tables, &params.scene);
        const Hit hit = intersectClosest(nodes, blocks, &ray);
        if (hit.primitive == QL_NONE) continue;
        const Surface s = addAovs(sums, &ray, &hit, place.weight, blocks, tables, &params.scene);
#ifdef HAS_UV_LAYERS
        const Ray besideX = cameraRay(camera, pixel, place.offset + (float2)(1, 0), lens);
        const Ray besideY = cameraRay(camera, pixel, place.offset + (float2)(0, 1), lens);
        addUvAovs(sums, &s, place.weight, &besideX, &besideY);
#endif
    }
    for (uint k = 0; k < AOV_FLOATS; ++k) aovs[(size_t)place * AOV_FLOATS + k] = sums[k] / samples;
}
