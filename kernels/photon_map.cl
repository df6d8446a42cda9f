/* Stage 2 of a pass: index the photons by class and cell, in the arrays that they were traced into (photon_store.clh). A
 * stable counting sort: each of `chunks` work-items counts, and later places, the photons of its own run of regions in order.
 * Within a cell they then stand in the order of their regions whatever the number of chunks, so sums over them are
 * reproducible. */
#include "cell_scan.clh"
#include "photon_store.clh"

inline uint cellOfTraced(__global const uint* photon, size_t stride, __global const uint* tables,
                         const MapParams* params) {
    const float3 position =
        (float3)(as_float(photon[TRACED(PHOTON_X) * stride]), as_float(photon[TRACED(PHOTON_Y) * stride]),
                 as_float(photon[TRACED(PHOTON_Z) * stride]));
    return cellOf(photon[PHOTON_CELL * stride], position, photon[TRACED(PHOTON_PATCH_SIDE) * stride], tables, params);
}

/* counts[chunk * cells + cell]; each photon's cell becomes known. */
__kernel void countPhotons(__global uint* photons, __global const uint* blocks, __global const RegionCount* regions,
                           __global const uint* tables, __global uint* counts, const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    const uint cells = cellCount(&params);
    const size_t stride = params.photonStride;
    __global uint* own = counts + (size_t)chunk * cells;
    for (uint cell = 0; cell < cells; ++cell) own[cell] = 0;
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region)
        for (BlockWalk walk = blocksOf(regions + region); walk.left > 0; toNextBlock(&walk, blocks)) {
            __global uint* block = photons + walk.block * PHOTON_BLOCK;
            for (uint k = 0; k < photonsInBlock(&walk); ++k) {
                const uint cell = cellOfTraced(block + k, stride, tables, &params);
                ++own[cell];
                block[PHOTON_CELL * stride + k] = cell;
            }
        }
}

/* From the photons' cells to which photon goes where. */
__kernel void placePhotons(__global uint* photons, __global const uint* blocks, __global const RegionCount* regions,
                           __global uint* counts, const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    __global uint* own = counts + (size_t)chunk * cellCount(&params);
    __global const uint* cells = photons + (size_t)PHOTON_CELL * params.photonStride;
    __global uint* sources = photons + (size_t)PHOTON_SOURCE * params.photonStride;
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region)
        for (BlockWalk walk = blocksOf(regions + region); walk.left > 0; toNextBlock(&walk, blocks)) {
            const uint first = walk.block * PHOTON_BLOCK;
            for (uint k = first; k < first + photonsInBlock(&walk); ++k) sources[own[cells[k]]++] = k;
        }
}

/* Moves one field of all photons to its place; the field before it has been moved. Behind the last of the `sorted` ones
 * as many zeros follow as are read in one go. */
__kernel void movePhotons(__global uint* photons, const uint field, const uint sorted, const MapParams params) {
    const uint photon = get_global_id(0);
    const size_t stride = params.photonStride;
    __global uint* to = photons + field * stride;
    if (photon < PHOTONS_READ) to[sorted + photon] = 0;
    if (photon < sorted) to[photon] = photons[TRACED(field) * stride + photons[PHOTON_SOURCE * stride + photon]];
}
