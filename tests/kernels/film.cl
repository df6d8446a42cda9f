/* Film sums, points of the lattice, and offsets of the reconstruction filter. */
#include "camera.clh"
#include "film.clh"

/* Adds samples `first` to before `end` of `count`, one after the other, to pixel `id` of `pixels`; component k of a
 * sample is its k-th share. */
__kernel void addSamples(__global const float4* samples, __global float* film, const uint pixels, const uint count,
                         const uint first, const uint end, const uint layout) {
    const uint pixel = get_global_id(0);
    if (pixel >= pixels) return;
    for (uint i = first; i < end; ++i) {
        const float3 value = samples[(size_t)pixel * count + i].xyz;
        float3 components[FILM_COMPONENTS];
        for (uint k = 0; k < FILM_COMPONENTS; ++k) components[k] = k == LIGHT_DIFFUSE ? value : (float3)0;
        components[FILM_EMISSION] = value * 0.5f;
        addSample(film, layout, pixel, components, 1);
    }
}

#if ESTIMATE_BIAS
/* One pass of diffuse light's bias alone, a value for each pixel. */
__kernel void addBiasOfPass(__global const float4* bias, __global float* film, const uint pixels,
                            const float batchWeight, const uint layout) {
    const uint pixel = get_global_id(0);
    if (pixel >= pixels) return;
    float3 components[FILM_SAMPLES];
    for (uint k = 0; k < FILM_SAMPLES; ++k) components[k] = 0;
    components[FILM_BIAS(LIGHT_DIFFUSE)] = bias[pixel].xyz;
    addSample(film, layout, pixel, components, batchWeight);
}
#endif

/* mode 0: point i of the plane lattice, shifted by `shift`; mode 1: dimensions first, first + 1 of point i of pass 0;
 * mode 2: of point 12345 of pass i. */
__kernel void latticePoints(__global float2* points, const uint count, const uint mode, const uint first,
                            const float2 shift) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Lattice lattice = latticeOfPass(99, mode == 1 ? 0 : i);
    points[i] = mode == 0 ? latticePlace(i, shift) : latticePoint2(&lattice, mode == 1 ? i : 12345, first);
}

#ifdef HAS_FILTER_TABLE
/* Offset and weight in pixel `pixel`. */
__kernel void filterPlaces(__global const float2* numbers, __global float4* places, __global const uint* tables,
                           const Camera camera, const uint pixel, const uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const FilterPlace place = filterPlace(&camera, tables, pixel, numbers[i]);
    places[i] = (float4)(place.offset, place.weight, 0);
}
#endif
