/* Sampling of one emitter: photons that leave it, directions to it. */
#include "emitter.clh"
#include "micro/numbers.clh"

inline EmitterData dataOf(__global const EmitterTriangle* triangles, __global const uint* words) {
    EmitterData data;
    data.triangles = triangles;
#ifdef HAS_EMITTER_ENVMAP
    data.environment = data.directEnvironment = (__global const EnvironmentMap*)words;
#endif
#ifdef HAS_EMITTER_GONIOGRAM
    data.goniograms = words;
#endif
    return data;
}

__kernel void sampleEmission(__global const Emitter* emitter, __global const EmitterTriangle* triangles,
                             __global const uint* words, __global float* sums, const uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    const EmitterData data = dataOf(triangles, words);
    uint state = firstState(item);
    float3 sum = 0;
    for (uint k = 0; k < SAMPLES_PER_ITEM; ++k) {
        const float select = nextNumber(&state);
        const float a = nextNumber(&state), b = nextNumber(&state), c = nextNumber(&state), d = nextNumber(&state);
        const EmittedPhoton p = emitterSampleEmission(emitter, &data, select, (float2)(a, b), (float2)(c, d));
        sum += p.position + p.direction + p.flux;
    }
    sums[item] = sum.x + sum.y + sum.z;
}

__kernel void sampleDirection(__global const Emitter* emitter, __global const EmitterTriangle* triangles,
                              __global const uint* words, __global float* sums, const uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    const EmitterData data = dataOf(triangles, words);
    uint state = firstState(item);
    float3 sum = 0;
    for (uint k = 0; k < SAMPLES_PER_ITEM; ++k) {
        const float select = nextNumber(&state), u = nextNumber(&state), v = nextNumber(&state);
        const float3 from = (float3)(u, v, -1 - select);
        const EmitterSample s = emitterSampleDirection(emitter, &data, from, select, (float2)(u, v));
        if (s.valid) sum += s.direction + s.radianceOverPdf;
    }
    sums[item] = sum.x + sum.y + sum.z;
}
