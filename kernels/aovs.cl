/* What the rays of a pixel meet first, as integrator 'aov' of Mitsuba shows it: distances, places, normals, reflectance. Means over
 * samples, seen through the same filter as the image; where a ray meets nothing, it adds nothing.
 * From: camera rays. To: AOV_FLOATS for each pixel. */
#include "aov_types.h"
#include "camera.clh"
#include "tinted_lobe.clh"

/* The share of diffuse light that a surface reflects. As in Mitsuba, lobes that are not diffuse count by pi f for light that leaves along
 * the normal, which may be above 1. */
inline float3 diffuseReflectance(const Surface* s, __global const Lobe* lobes, float3 wo) {
    float3 sum = 0;
    for (uint k = 0; k < s->lobeCount; ++k) {
        if (lobes[k].type == LOBE_LAMBERT)
            sum += tinted(s, k, loadRgb(lobes[k].reflectance));
        else if (lobes[k].type == LOBE_COATEDLAMBERT) /* of the base: the coat's own factors are taken out again */
            sum += tinted(s, k, loadRgb(lobes[k].reflectance) * lobes[k].exponent);
        else if (lobes[k].scattering != SCATTER_SPECULAR)
            sum += M_PI_F * tintedEval(s, lobes, k, wo, (float3)(0, 0, 1));
    }
    return sum;
}

inline void addTriple(float* sums, float3 value) { vstore3(vload3(0, sums) + value, 0, sums); }

inline void addAovs(float* sums, const Ray* ray, Hit hit, float weight, __global const PrimitiveBlock* blocks,
                    __global const uint* tables, const SceneTables* scene) {
    const Surface s = surfaceAt(hit, ray->origin, ray->direction, blocks, tables, scene);
    __global const Lobe* lobes = SCENE_TABLE(tables, scene, Lobe, lobes) + s.firstLobe;
    const Frame frame = frameFromNormal(s.shadingNormal);
    const float side = s.front ? weight : -weight; /* normals are those of the surface, on whatever side it is met */
    addTriple(sums + AOV_ALBEDO, weight * diffuseReflectance(&s, lobes, toLocal(&frame, -ray->direction)));
    addTriple(sums + AOV_POSITION, weight * s.position);
    addTriple(sums + AOV_GEO_NORMAL, side * s.geometricNormal);
    addTriple(sums + AOV_SH_NORMAL, side * s.shadingNormal);
    sums[AOV_DEPTH] += weight * (hit.t - ray->tMin); /* from the near clipping plane */
    const uint first = SCENE_TABLE(tables, scene, Shape, shapes)[s.shape].firstPrimitive;
    sums[AOV_PRIM_INDEX] += weight * (float)((hit.primitive & PRIMITIVE_INDEX_MASK) - first);
    sums[AOV_SHAPE_INDEX] += weight * (float)(s.shape + 1);
    sums[AOV_COVERAGE] += weight;
}

/* Does the ray meet anything but null surfaces? */
inline int meetsSurface(Ray ray, Hit hit, __global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                        __global const uint* tables, const SceneTables* scene) {
    for (uint event = 0; event < PATH_EVENTS_MAX && hit.primitive != QL_NONE; ++event) {
        const Surface s = surfaceAt(hit, ray.origin, ray.direction, blocks, tables, scene);
        if (!s.isNull) return 1;
        const float tMax = ray.tMax - hit.t;
        ray = leavingRay(&s, ray.direction);
        ray.tMax = tMax;
        hit = intersectClosest(nodes, blocks, ray);
    }
    return 0;
}

__kernel void traceAovs(__global const BvhNode* nodes, __global const PrimitiveBlock* blocks,
                        __global const uint* tables, __global float* aovs, const CameraParams params,
                        const uint samples) {
    const uint pixel = get_global_id(0);
    const Camera* camera = &params.camera;
    if (pixel >= camera->width * camera->height) return;
    const ulong seed = (ulong)params.seedHigh << 32 | params.seedLow;
    float sums[AOV_FLOATS];
    for (uint k = 0; k < AOV_FLOATS; ++k) sums[k] = 0;
    for (uint sample = 0; sample < samples; ++sample) {
        const FilterPlace place = filterPlace(camera, tables, pixel, pixelNumbers(pixel, sample, seed).xy);
        const Ray ray = cameraRay(camera, pixel, place.offset, lensNumbers(pixel, sample, seed));
        const Hit hit = intersectClosest(nodes, blocks, ray);
        if (hit.primitive == QL_NONE) continue;
        addAovs(sums, &ray, hit, place.weight, blocks, tables, &params.scene);
        if (meetsSurface(ray, hit, nodes, blocks, tables, &params.scene)) sums[AOV_ALPHA] += place.weight;
    }
    for (uint k = 0; k < AOV_FLOATS; ++k) aovs[(size_t)pixel * AOV_FLOATS + k] = sums[k] / samples;
}
