/* Phase functions of kernels/phase.clh over arrays of cosines and numbers. */
#include "phase.clh"

__kernel void phaseValues(__global const Medium* medium, __global const float* cosTheta, __global float* result,
                          uint count) {
    const uint i = get_global_id(0);
    if (i < count) result[i] = phaseValue(medium, cosTheta[i]);
}

/* `count` groups of eight cosines. */
__kernel void phaseValuesByEight(__global const Medium* medium, __global const float* cosTheta, __global float* result,
                                 uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore8(phaseValue8(medium, vload8(i, cosTheta)), i, result);
}

/* Result: direction after scattering (3). Numbers: u.x, u.y. */
__kernel void sampleDirections(__global const Medium* medium, float directionX, float directionY, float directionZ,
                               __global const float* numbers, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 direction = (float3)(directionX, directionY, directionZ);
    vstore3(phaseSampleDirection(medium, direction, vload2(i, numbers)), i, result);
}

/* Result: kind of scattering, genuine diffuse part, quasi-specular part. Numbers: p, u. */
__kernel void splitEvents(__global const Medium* medium, __global const float* numbers, __global float* result,
                          uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float p = numbers[2 * i], u = numbers[2 * i + 1];
    vstore3((float3)(phaseEvent(medium, p, u), phasePart(medium, SCATTER_GENUINE_DIFFUSE, p),
                     phasePart(medium, SCATTER_QUASI_SPECULAR, p)),
            i, result);
}

__kernel void possibleScatterings(__global const Medium* medium, __global uint* result) {
    if (get_global_id(0) == 0) result[0] = phaseScatterings(medium);
}

/* Result: 1 - cos of a scattering angle; by eight the same. */
__kernel void sampleAngles(__global const Medium* medium, __global const float* numbers, __global float* result,
                           uint count) {
    const uint i = get_global_id(0);
    if (i < count) result[i] = phaseSampleOneMinusCos(medium, numbers[i]);
}

__kernel void sampleAnglesByEight(__global const Medium* medium, __global const float* numbers, __global float* result,
                                  uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore8(phaseSampleOneMinusCos8(medium, vload8(i, numbers)), i, result);
}
