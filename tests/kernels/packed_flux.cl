/* Flux packed with given random bits, and unpacked again. */
#include "packed_flux.clh"

__kernel void packAll(__global const float4* flux, __global const uint* random, __global uint* packed,
                      __global int* clipped, const uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    int tooLarge;
    packed[i] = packFlux(flux[i].xyz, random[i], &tooLarge);
    clipped[i] = tooLarge;
}

__kernel void unpackAll(__global const uint* packed, __global float4* flux, const uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const uint8 same = packed[i];
    flux[i] = (float4)(unpackedRed8(same).s0, unpackedGreen8(same).s3, unpackedBlue8(same).s7, 0);
}

/* Of paths in a row, each at the end of eight segments. */
__kernel void roundings(__global uint* random, const uint count) {
    const uint i = get_global_id(0);
    if (i < count) random[i] = roundingOf(rngMake(1, 2, 3, i / 8).key, i % 8);
}
