/* Lobes of kernels/bsdf/ over arrays of directions and numbers. */
#include "bsdf/lobe.clh"

/* Result: wi (3), weight (3), pdf, valid. Numbers: uChoice, u.x, u.y. */
__kernel void sampleLobe(__global const Lobe* lobe, float woX, float woY, float woZ, int transport,
                         __global const float* numbers, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 u = vload3(i, numbers);
    const LobeSample s = lobeSample(lobe, (float3)(woX, woY, woZ), u.x, u.yz, transport);
    vstore3(s.wi, 0, result + 8 * i);
    vstore3(s.weight, 0, result + 8 * i + 3);
    result[8 * i + 6] = s.pdfSolidAngle;
    result[8 * i + 7] = s.valid ? 1.0f : 0.0f;
}

/* Result: f (3), pdf. */
__kernel void evaluateLobe(__global const Lobe* lobe, __global const float* wo, __global const float* wi,
                           __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 o = vload3(i, wo), d = vload3(i, wi);
    vstore4((float4)(lobeEval(lobe, o, d), lobePdfSolidAngle(lobe, o, d)), i, result);
}

__kernel void lobeAlbedos(__global const Lobe* lobe, __global const float* wo, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore3(lobeAlbedo(lobe, vload3(i, wo)), i, result);
}

/* Result: reflectance, cosine of the refracted direction. */
__kernel void dielectricReflectance(__global const float* cosI, __global const float* eta, __global float* result,
                                    uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    float cosT;
    result[2 * i] = fresnelDielectric(cosI[i], eta[i], &cosT);
    result[2 * i + 1] = cosT;
}

__kernel void conductorReflectance(__global const float* cosI, __global const float* eta, __global const float* k,
                                   __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i < count) result[i] = fresnelConductor(cosI[i], (float3)(eta[i]), (float3)(k[i])).y;
}
