/* Draws of kernels/rng.clh, laid out as [path][dimension]. */
#include "lattice.clh"
#include "rng.clh"

__kernel void draw(ulong seed, uint pass, uint stream, uint firstPath, uint dimensions, __global float* result,
                   uint paths) {
    const uint i = get_global_id(0);
    if (i >= paths) return;
    Rng rng = rngMake(seed, pass, stream, firstPath + i);
    for (uint d = 0; d < dimensions; ++d) result[i * dimensions + d] = rngNext(&rng);
}

__kernel void drawPairs(ulong seed, uint pass, uint stream, __global float* result, uint paths) {
    const uint i = get_global_id(0);
    if (i >= paths) return;
    Rng rng = rngMake(seed, pass, stream, i);
    const float2 u = rngNext2(&rng);
    result[2 * i] = u.x;
    result[2 * i + 1] = u.y;
}

__kernel void mixNumbers(__global const ulong* input, __global ulong* result, uint count) {
    const uint i = get_global_id(0);
    if (i < count) result[i] = rngMix(input[i]);
}

/* Choices among emitters of `passes` passes of a pixel. */
__kernel void chooseEvenly(uint shift, __global float* result, uint passes) {
    const uint i = get_global_id(0);
    if (i < passes) result[i] = evenChoice(shift, i);
}
