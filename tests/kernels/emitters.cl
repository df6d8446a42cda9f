/* Emitters of kernels/emitter.clh over arrays of numbers and points. */
#include "emitter.clh"

inline EmitterData dataOf(__global const EmitterTriangle* triangles, __global const uint* environment) {
    EmitterData data;
    data.triangles = triangles;
    data.environment = data.directEnvironment = (__global const EnvironmentMap*)environment;
    return data;
}

/* Result: direction (3), distance, radianceOverPdf (3), pdf; an invalid sample has distance -1. Numbers: uSelect, u. */
__kernel void sampleDirections(__global const Emitter* emitters, __global const EmitterTriangle* triangles,
                               __global const uint* environment, uint emitterCount, float x, float y, float z,
                               __global const float* numbers, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(triangles, environment);
    const float3 u = vload3(i, numbers);
    float rest = u.x;
    const uint chosen = emitterSelect(emitters, emitterCount, &rest);
    EmitterSample s = emitterSampleDirection(emitters + chosen, &data, (float3)(x, y, z), rest, u.yz);
    s.radianceOverPdf /= emitters[chosen].selectionProbability;
    s.pdfSolidAngle *= emitters[chosen].selectionProbability;
    vstore3(s.direction, 0, result + 8 * i);
    result[8 * i + 3] = s.valid ? s.distance : -1.0f;
    vstore3(s.radianceOverPdf, 0, result + 8 * i + 4);
    result[8 * i + 7] = s.pdfSolidAngle;
}

/* Density for points (3) with normals (3) of emitter `index`. */
__kernel void directionPdfs(__global const Emitter* emitters, __global const uint* environment, uint index, float x,
                            float y, float z, __global const float* points, __global const float* normals,
                            __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(0, environment);
    const float3 from = (float3)(x, y, z);
    const float3 offset = vload3(i, points) - from;
    const float distance = length(offset);
    result[i] = emitters[index].selectionProbability *
                emitterPdfSolidAngle(emitters + index, &data, from, offset / distance, distance, vload3(i, normals));
}

/* Result: position (3), direction (3), normal (3), flux (3). Numbers: uSelect, uPosition, uDirection. */
__kernel void samplePhotons(__global const Emitter* emitters, __global const EmitterTriangle* triangles,
                            __global const uint* environment, uint emitterCount, __global const float* numbers,
                            __global float* result, __global uint* chosen, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(triangles, environment);
    __global const float* u = numbers + 5 * i;
    float part = u[0];
    const uint index = emitterSelect(emitters, emitterCount, &part);
    EmittedPhoton p = emitterSampleEmission(emitters + index, &data, part, (float2)(u[1], u[2]), (float2)(u[3], u[4]));
    p.flux /= emitters[index].selectionProbability;
    p.emitter = index;
    vstore3(p.position, 0, result + 12 * i);
    vstore3(p.direction, 0, result + 12 * i + 3);
    vstore3(p.normal, 0, result + 12 * i + 6);
    vstore3(p.flux, 0, result + 12 * i + 9);
    chosen[i] = p.emitter;
}

/* Radiance against each direction (3). */
__kernel void radiances(__global const Emitter* emitter, __global const uint* environment,
                        __global const float* directions, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(0, environment);
    vstore3(emitterRadiance(emitter, &data, vload3(i, directions), 0), i, result);
}

/* The numbers (5) that emitterInvertEmission gives of the photons of samplePhotons. */
__kernel void invertPhotons(__global const Emitter* emitter, __global const EmitterTriangle* triangles,
                            __global const uint* environment, __global const float* numbers, __global float* result,
                            uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const EmitterData data = dataOf(triangles, environment);
    __global const float* u = numbers + 5 * i;
    const EmittedPhoton p = emitterSampleEmission(emitter, &data, u[0], (float2)(u[1], u[2]), (float2)(u[3], u[4]));
    const EmissionNumbers n =
        emitterInvertEmission(emitter, &data, 0, p.position, p.direction, (float3)(u[0], u[1], u[2]));
    result[5 * i] = n.part;
    vstore2(n.position, 0, result + 5 * i + 1);
    vstore2(n.direction, 0, result + 5 * i + 3);
}
