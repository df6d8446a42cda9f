/* Sampling and evaluation of one phase function. */
#include "micro/numbers.clh"
#include "phase.clh"

__kernel void samplePhase(__global const Medium* medium, __global float* sums, const uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    uint state = firstState(item);
    float3 direction = (float3)(0.4f, 0.3f, 0.8660254f);
    for (uint k = 0; k < SAMPLES_PER_ITEM; ++k) {
        const float u = nextNumber(&state), v = nextNumber(&state);
        direction = phaseSampleDirection(medium, direction, (float2)(u, v));
    }
    sums[item] = direction.x + direction.y + direction.z;
}

__kernel void evaluatePhase(__global const Medium* medium, __global float* sums, const uint count) {
    const uint item = get_global_id(0);
    if (item >= count) return;
    uint state = firstState(item);
    float sum = 0;
    for (uint k = 0; k < SAMPLES_PER_ITEM; ++k) sum += phaseValue(medium, 2 * nextNumber(&state) - 1);
    sums[item] = sum;
}
