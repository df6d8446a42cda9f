/* Stage 2 of a pass: index the photons by class and cell, as a stable counting sort (count, prefix sum, scatter).
 *
 * Each of `chunks` work-items counts, and later scatters, its own run of regions in order; within a cell the photons
 * then stand in the order of their paths whatever the number of chunks, so sums over them are reproducible. */
#include "cell_scan.clh"

inline uint photonCell(__global const Photon* photon, __global const uint* tables, const MapParams* params) {
    return cellOf(photon->classDepth & (PHOTON_SLOTS - 1), load3(photon->position), photon->patchSide, tables, params);
}

/* counts[chunk * cells + cell] */
__kernel void countPhotons(__global const Photon* photons, __global const RegionCount* regions,
                           __global const uint* tables, __global uint* counts, const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    const uint cells = cellCount(&params);
    __global uint* own = counts + (size_t)chunk * cells;
    for (uint cell = 0; cell < cells; ++cell) own[cell] = 0;
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region) {
        __global const Photon* first = photons + (size_t)region * params.regionCapacity;
        for (uint k = 0; k < regions[region].stored; ++k) ++own[photonCell(first + k, tables, &params)];
    }
}

inline void placePhoton(__global const Photon* photon, __global uint* sorted, uint place, uint stride) {
    sorted[(size_t)PHOTON_X * stride + place] = as_uint(photon->position.x);
    sorted[(size_t)PHOTON_Y * stride + place] = as_uint(photon->position.y);
    sorted[(size_t)PHOTON_Z * stride + place] = as_uint(photon->position.z);
    sorted[(size_t)PHOTON_R * stride + place] = as_uint(photon->flux.r);
    sorted[(size_t)PHOTON_G * stride + place] = as_uint(photon->flux.g);
    sorted[(size_t)PHOTON_B * stride + place] = as_uint(photon->flux.b);
    sorted[(size_t)PHOTON_PATCH_SIDE * stride + place] = photon->patchSide;
    sorted[(size_t)PHOTON_DIRECTION * stride + place] = photon->direction;
#ifdef HAS_DEPTH_LIMIT
    sorted[(size_t)PHOTON_DEPTH * stride + place] = photon->classDepth >> 3;
#endif
}

__kernel void scatterPhotons(__global const Photon* photons, __global const RegionCount* regions,
                             __global const uint* tables, __global uint* counts, __global uint* sorted,
                             const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    __global uint* own = counts + (size_t)chunk * cellCount(&params);
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region) {
        __global const Photon* first = photons + (size_t)region * params.regionCapacity;
        for (uint k = 0; k < regions[region].stored; ++k)
            placePhoton(first + k, sorted, own[photonCell(first + k, tables, &params)]++, params.photonStride);
    }
}
