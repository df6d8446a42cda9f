/* A luminaire, for tests of what it sends. */
#include "emitter.clh"

inline EmitterData dataOf(__global const uint* goniograms) {
    EmitterData data;
    data.triangles = 0;
    data.goniograms = goniograms;
    return data;
}

/* Irradiance (3) across the direction to the luminaire's sample, and the place (3) of that sample, at each point (3);
 * numbers: part, u. */
__kernel void irradiances(__global const Emitter* emitter, __global const uint* goniograms,
                          __global const float* points, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(goniograms);
    __global const float* given = points + 6 * i;
    const float3 from = vload3(0, given);
    const EmitterSample s = emitterSampleDirection(emitter, &data, from, given[3], (float2)(given[4], given[5]));
    vstore3(s.valid ? s.radianceOverPdf : (float3)(0.0f), 2 * i, result);
    vstore3(from + s.distance * s.direction, 2 * i + 1, result);
}

/* Position (3), direction (3), flux (3), and the numbers (5) found again, by the numbers (5): part, position,
 * direction. */
__kernel void photons(__global const Emitter* emitter, __global const uint* goniograms, __global const float* numbers,
                      __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(goniograms);
    __global const float* u = numbers + 5 * i;
    const EmittedPhoton p = emitterSampleEmission(emitter, &data, u[0], (float2)(u[1], u[2]), (float2)(u[3], u[4]));
    const EmissionNumbers found = emitterInvertEmission(emitter, &data, 0, p.position, p.direction, (float3)(0.5f));
    __global float* out = result + 14 * i;
    vstore3(p.position, 0, out);
    vstore3(p.direction, 0, out + 3);
    vstore3(p.flux, 0, out + 6);
    out[9] = found.part;
    vstore2(found.position, 0, out + 10);
    vstore2(found.direction, 0, out + 12);
}
