/* Choices by the light tree (kernels/light_tree.clh) for one place. */
#include "light_tree.clh"

__kernel void chooseLights(__global const LightNode* nodes, uint emitters, float x, float y, float z,
                           __global const float* numbers, __global uint* chosen, __global float* probabilities,
                           uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    float u = numbers[i], probability;
    chosen[i] = lightOfTree(nodes, emitters, (float3)(x, y, z), &u, &probability);
    probabilities[i] = probability;
}

__kernel void lightProbabilities(__global const LightNode* nodes, uint emitters, float x, float y, float z,
                                 __global float* probabilities) {
    const uint i = get_global_id(0);
    if (i >= emitters) return;
    probabilities[i] = lightOfTreeProbability(nodes, emitters, (float3)(x, y, z), i);
}
