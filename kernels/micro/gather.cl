/* gatherPhotons about whole discs, as the density estimate does away from borders: per query the sum of flux times
 * kernel. */
#include "micro/gather_photons.clh"
#include "micro/gather_types.h"

__kernel void gather(__global const uint* cellStart, __global const uint* sorted, __global const GatherQuery* queries,
                     __global GatherSum* sums, const MapParams map, const uint count, const uint lightClass) {
    const uint i = get_global_id(0);
    if (i >= count) return;
    const PhotonMap photons = {sorted, cellStart, &map};
    const float radius = map.radius[lightClass];
    DensityRegion region;
    region.center = load3(queries[i].position);
    region.frame = frameFromNormal((float3)(0, 0, 1));
    region.radiusSquared = radius * radius;
    region.bordered = 0;
    region.kernelIntegral = regionIntegral(&region);
    const DirectionalLobes none = {0, 0, region.frame, (float3)(0, 0, 1), 0};
    const PhotonSums found = gatherPhotons(photons, lightClass, &region, queries[i].patchSide, QL_NONE, &none);
    const Rgb irradiance = {found.irradiance.x, found.irradiance.y, found.irradiance.z};
    const Rgb bias = {found.irradianceBias.x, found.irradianceBias.y, found.irradianceBias.z};
    sums[i].irradiance = irradiance;
    sums[i].bias = bias;
}
