/* Directions drawn to an opening far away, and what the density of aiming says of them after the turns that a photon's
 * direction goes through. */
#include "aim.clh"

__kernel void aimAtOpening(__global const AimSource* openings, float px, float py, float pz, __global const float* u,
                           __global float* pdfSolidAngle, uint count) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const Aim aim = {0, 1, 1, 1};
    const float3 position = (float3)(px, py, pz);
    const Frame frame = frameFromNormal(normalize((float3)(0.3f, -0.2f, 1)));
    uint drawn = QL_NONE;
    const float3 turned = toLocal(&frame, sampleAim(&aim, openings, position, 0, vload2(i, u), &drawn));
    pdfSolidAngle[i] = aimPdfSolidAngle(&aim, openings, drawn, position, toWorld(&frame, turned));
}

/* Where a cell of this word aims: first opening, how many, probability. */
__kernel void aimOfWord(__global const uint* tables, const SceneTables scene, __global float* aims) {
    const Aim aim = aimFrom(tables, &scene, 0);
    vstore3((float3)(aim.first, aim.count, aim.probability), 0, aims);
}
