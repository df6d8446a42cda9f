/* Stage 2 of a pass: index the photons by class and cell, as a stable counting sort (count, prefix sum, scatter).
 *
 * Each of `chunks` work-items counts, and later scatters, its own run of regions in order; within a cell the photons
 * then stand in the order of their paths whatever the number of chunks, so sums over them are reproducible. */
#include "photon_grid.clh"

inline uint photonCell(__global const Photon* photon, __global const uint* tables, const MapParams* params) {
    const uint slot = photon->classDepth & (PHOTON_SLOTS - 1);
    const float3 position = load3(photon->position);
    int3 c;
#ifdef HAS_MEDIA
    if (slot >= LIGHT_CLASSES) {
        __global const Medium* medium = (__global const Medium*)(tables + params->media) + photon->patchSide;
        const KernelSpace space = kernelSpaceOf(medium, slot - LIGHT_CLASSES, params->volumeScale);
        c = gridCoordinate(toKernelSpace(&space, position), 1);
    } else
#endif
        c = gridCoordinate(position, params->radius[slot]);
    return CLASS_SLOT(slot) * (params->cellMask + 1) + gridCell(c, params->cellMask);
}

inline uint cellCount(const MapParams* params) { return CLASS_SLOTS * (params->cellMask + 1); }

/* First region of a chunk; the chunk ends where the next begins. */
inline uint chunkRegion(uint chunk, const MapParams* params) {
    return (uint)((ulong)params->regions * chunk / params->chunks);
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

inline uint scanBlockFirst(uint block, const MapParams* params) {
    return (uint)((ulong)cellCount(params) * block / params->scanBlocks);
}

/* Photons in each block of cells. */
__kernel void sumBlocks(__global const uint* counts, __global uint* blockSums, const MapParams params) {
    const uint block = get_global_id(0);
    if (block >= params.scanBlocks) return;
    const uint cells = cellCount(&params);
    uint sum = 0;
    for (uint chunk = 0; chunk < params.chunks; ++chunk)
        for (uint cell = scanBlockFirst(block, &params); cell < scanBlockFirst(block + 1, &params); ++cell)
            sum += counts[(size_t)chunk * cells + cell];
    blockSums[block] = sum;
}

/* counts become the place of the chunk's first photon of the cell; cellStart the place of the cell's first photon. */
__kernel void scanCells(__global uint* counts, __global const uint* blockSums, __global uint* cellStart,
                        const MapParams params) {
    const uint block = get_global_id(0);
    if (block >= params.scanBlocks) return;
    const uint cells = cellCount(&params);
    uint place = 0;
    for (uint before = 0; before < block; ++before) place += blockSums[before];
    for (uint cell = scanBlockFirst(block, &params); cell < scanBlockFirst(block + 1, &params); ++cell) {
        cellStart[cell] = place;
        for (uint chunk = 0; chunk < params.chunks; ++chunk) {
            const uint here = counts[(size_t)chunk * cells + cell];
            counts[(size_t)chunk * cells + cell] = place;
            place += here;
        }
    }
    if (block == params.scanBlocks - 1) cellStart[cells] = place;
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
