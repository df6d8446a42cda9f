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

/* Choices among emitters of `passes` passes of a pixel with one path each. */
__kernel void chooseEvenly(uint shift, __global float* result, uint passes) {
    const uint i = get_global_id(0);
    if (i >= passes) return;
    const Net net = netOfPath(shift, i, 1, 0);
    result[i] = netNumbers(&net, NET_EMITTER).x;
}

/* Both pairs and choices of the nets of a pixel with `paths` paths a pass, of their first event (0) or of a later one: six numbers a point. */
__kernel void drawNets(ulong seed, uint paths, uint place, uint event, __global float* result, uint points) {
    const uint i = get_global_id(0);
    if (i >= points) return;
    const Net first = netOfPath(seed, i, paths, place), net = event == 0 ? first : netOfEvent(&first, event);
    for (uint use = 0; use < 2; ++use) vstore3(netNumbers(&net, use).yzx, 0, result + 6 * i + 3 * use);
}

/* All that one path of a pixel draws from sequences over the passes: its place, lens, choices and roulette. */
__kernel void drawSequences(__global float* result, uint passes) {
    const uint i = get_global_id(0);
    if (i >= passes) return;
    vstore2(latticePlace(i, (float2)(0.1f, 0.7f)), 0, result + 7 * i);
    vstore2(latticeLens(i, (float2)(0.9f, 0.2f)), 0, result + 7 * i + 2);
    vstore2(latticeChoices(i, (uint2)(123456789u, 2345678901u)), 0, result + 7 * i + 4);
    result[7 * i + 6] = latticeRoulette(i, 3456789012u);
}
