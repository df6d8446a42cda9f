/* Sampling and evaluation of one lobe. */
#include "bsdf/lobe.clh"
#include "micro/numbers.clh"

__constant float3 fixedOutgoing = (float3)(0.4f, 0.3f, 0.8660254f);

__kernel void sampleLobes(__global const Lobe* lobe, __global float* sums, const uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    uint state = firstState(item);
    float3 sum = 0;
    for (uint k = 0; k < SAMPLES_PER_ITEM; ++k) {
        const float choice = nextNumber(&state), u = nextNumber(&state), v = nextNumber(&state);
        const LobeSample s = lobeSample(lobe, fixedOutgoing, choice, (float2)(u, v), 0);
        if (s.valid) sum += s.wi + s.weight;
    }
    sums[item] = sum.x + sum.y + sum.z;
}

__kernel void evaluateLobes(__global const Lobe* lobe, __global float* sums, const uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    uint state = firstState(item);
    float3 sum = 0;
    for (uint k = 0; k < SAMPLES_PER_ITEM; ++k) sum += lobeEval(lobe, fixedOutgoing, upperDirection(&state));
    sums[item] = sum.x + sum.y + sum.z;
}
