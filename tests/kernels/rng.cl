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

/* All that one path of a pixel draws from sequences over the passes: its place, first choice, roulette, lens and emitter. */
__kernel void drawSequences(__global float* result, uint passes) {
    const uint i = get_global_id(0);
    if (i >= passes) return;
    const float4 pixel = latticePoint4(i, (float4)(0.1f, 0.7f, 0.3f, 0.5f));
    const float2 lens = latticeLens(i, (float2)(0.9f, 0.2f));
    vstore4(pixel, 0, result + 7 * i);
    vstore2(lens, 0, result + 7 * i + 4);
    result[7 * i + 6] = evenChoice(123456789u, i);
}
