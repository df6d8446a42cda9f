/* Grids of kernels/volume_grid.clh over arrays of rays, points and numbers. */
#include "medium.clh"

inline float3 packed(__global const float* v) { return (float3)(v[0], v[1], v[2]); }

/* Rays: origin, direction, length. */
__kernel void opticalDepths(__global const Medium* medium, __global const float* rays, __global float* result,
                            uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    __global const float* ray = rays + 7 * i;
    result[i] = opticalDepth(medium, packed(ray), packed(ray + 3), ray[6]);
}

/* Flights along one ray; the result is the distance of the collision, infinite where there is none. */
__kernel void flightDistances(__global const Medium* medium, __global const float* ray, __global const float* numbers,
                              __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    result[i] = flightDistance(medium, 1, packed(ray), packed(ray + 3), ray[6], (float2)(numbers[i], 0));
}

/* The density and the albedo at each point: four numbers. */
__kernel void valuesAt(__global const Medium* medium, __global const float* points, __global float* result,
                       uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 p = packed(points + 3 * i);
    result[4 * i] = gridDensity(extinctionGrid(medium), p) * medium->extinctionScale;
    vstore3(mediumAlbedo(medium, p), 0, result + 4 * i + 1);
}

/* What is left of each number where the ray's end comes before the collision. */
__kernel void numbersLeft(__global const Medium* medium, __global const float* ray, __global const float* numbers,
                          __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 origin = packed(ray), direction = packed(ray + 3);
    const float distance = flightDistance(medium, 1, origin, direction, ray[6], (float2)(numbers[i], 0));
    const FreeFlight flight = freeFlight(medium, 1, distance, ray[6]);
    result[i] = numberLeft(medium, origin, direction, &flight, numbers[i]);
}
