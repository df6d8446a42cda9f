/* Adds values to the sums of a single pixel from many work-items at once, and takes them again. */
#define PHOTON_CLASSES 8u
#include "splat_sums.clh"

__kernel void addAll(__global const float* values, __global uint* sums, __global uint* overflows, const uint count) {
    const uint i = get_global_id(0);
    if (i < count) overflows[i] = addSplat(sums, 0, LIGHT_DIFFUSE, (float3)(values[i], -values[i], 1));
}

__kernel void takeAll(__global uint* sums, __global float* taken) {
    if (get_global_id(0) == 0) vstore3(takeSplats(sums, 0, LIGHT_DIFFUSE), 0, taken);
}
