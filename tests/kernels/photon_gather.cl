/* gatherPhotons about whole discs: per query the sum of flux times kernel, in R, G and B. */
#include "micro/gather_photons.clh"

__kernel void gather(__global const uint* cellStart, __global const uint* sorted, __global const float4* queries,
                     __global float4* sums, const MapParams map, const uint count, const uint lightClass,
                     const uint patchSide, const uint depthMax) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const PhotonMap photons = {sorted, cellStart, &map};
    DensityRegion region;
    region.center = queries[i].xyz;
    region.frame = frameFromNormal((float3)(0, 0, 1));
    region.radiusSquared = queries[i].w * queries[i].w;
    region.bordered = 0;
    region.kernelIntegral = regionIntegral(&region);
    DirectionalLobes none = {0, 0, region.frame, (float3)(0, 0, 1)};
    const PhotonSums found = gatherPhotons(photons, lightClass, &region, patchSide, depthMax, &none);
    sums[i] = (float4)(found.irradiance, 0);
}
