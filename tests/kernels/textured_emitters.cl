/* A point emitter with a texture, for tests of what it sends. */
#include "emitter.clh"

inline EmitterData dataOf(__global const Texture* texture, __global const Rgb* texels) {
    EmitterData data;
    data.triangles = 0;
    data.textures.textures = texture;
    data.textures.texels = texels;
    return data;
}

/* Radiant intensity (3) along each unit direction (3) away from it; 0 where a sample is refused. */
__kernel void intensities(__global const Emitter* emitter, __global const Texture* texture, __global const Rgb* texels,
                          __global const float* directions, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(texture, texels);
    const float3 from = load3(emitter->origin) + 2.0f * vload3(i, directions);
    const EmitterSample s = emitterSampleDirection(emitter, &data, from, 0.5f, (float2)(0.3f, 0.7f));
    vstore3(s.valid ? s.radianceOverPdf * (s.distance * s.distance) : (float3)(0.0f), i, result);
}

/* Direction (3), flux (3) and the numbers (2) of the direction found again, by the numbers (2) of a direction. */
__kernel void photons(__global const Emitter* emitter, __global const Texture* texture, __global const Rgb* texels,
                      __global const float* numbers, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(texture, texels);
    const float2 u = vload2(i, numbers);
    const EmittedPhoton p = emitterSampleEmission(emitter, &data, 0.5f, (float2)(0.5f), u);
    const EmissionNumbers found = emitterInvertEmission(emitter, &data, 0, p.position, p.direction, (float3)(0.5f));
    vstore3(p.direction, 0, result + 8 * i);
    vstore3(p.flux, 0, result + 8 * i + 3);
    vstore2(found.direction, 0, result + 8 * i + 6);
}
