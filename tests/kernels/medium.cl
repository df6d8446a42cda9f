/* Free flight and transmittance of kernels/medium.clh over arrays of numbers. */
#include "medium.clh"

/* Result: distance, collided, weight (3). Numbers: u.x, u.y. */
__kernel void sampleFlights(__global const Medium* medium, float red, float green, float blue, float tMax,
                            __global const float* numbers, __global float* result, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const float3 throughput = (float3)(red, green, blue);
    const float distance = sampleFlightDistance(medium, throughput, vload2(i, numbers));
    const FreeFlight flight = freeFlight(medium, throughput, distance, tMax);
    result[5 * i] = flight.distance;
    result[5 * i + 1] = flight.collided ? 1.0f : 0.0f;
    vstore3(flight.weight, 0, result + 5 * i + 2);
}

__kernel void transmittances(__global const Medium* medium, __global const float* distance, __global float* result,
                             uint count) {
    const uint i = get_global_id(0);
    if (i < count) vstore3(mediumTransmittance(medium, distance[i]), i, result);
}

/* Result: medium on the side of the normal, medium behind, and is each a medium. */
__kernel void mediaBeyond(__global const Shape* shape, uint current, __global uint* result) {
    if (get_global_id(0) != 0) return;
    for (int side = 0; side < 2; ++side) {
        result[side] = mediumBeyond(shape, side == 0, current);
        result[2 + side] = inMedium(result[side]) ? 1 : 0;
    }
}
