/* Warps of kernels/sampling.clh over an array of numbers: result (x, y, z, density). */
#include "sampling.clh"

#define WARP_DISC 0
#define WARP_COSINE_HEMISPHERE 1
#define WARP_UNIFORM_SPHERE 2
#define WARP_UNIFORM_CONE 3 /* parameter: 1 - cosMax */
#define WARP_TRIANGLE 4

static float4 warp(uint kind, float parameter, float2 u) {
    switch (kind) {
    case WARP_DISC:
        return (float4)(sampleUniformDisc(u), 0.0f, pdfAreaUniformDisc());
    case WARP_COSINE_HEMISPHERE: {
        const float3 d = sampleCosineHemisphere(u);
        return (float4)(d, pdfSolidAngleCosineHemisphere(d.z));
    }
    case WARP_UNIFORM_SPHERE:
        return (float4)(sampleUniformSphere(u), pdfSolidAngleUniformSphere());
    case WARP_UNIFORM_CONE:
        return (float4)(sampleUniformCone(u, parameter), pdfSolidAngleUniformCone(parameter));
    default:
        return (float4)(sampleUniformTriangle(u), 0.0f, pdfAreaUniformTriangle(0.5f));
    }
}

__kernel void warpNumbers(uint kind, float parameter, __global const float* u, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore4(warp(kind, parameter, vload2(i, u)), i, result);
}
