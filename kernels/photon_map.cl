/* Stage 2 of a pass: index the photons by class and cell, in the arrays that they were traced into
 * (photon_store.clh). */
#include "cell_sort.clh"
#include "photon_store.clh"

inline uint cellOfTraced(__global const uint* photon, size_t stride, __global const uint* tables,
                         const MapParams* params) {
    const float3 position =
        (float3)(as_float(photon[TRACED(PHOTON_X) * stride]), as_float(photon[TRACED(PHOTON_Y) * stride]),
                 as_float(photon[TRACED(PHOTON_Z) * stride]));
    return cellOf(photon[PHOTON_CELL * stride], position, photon[TRACED(PHOTON_PATCH_SIDE) * stride], tables, params);
}

/* Each photon's cell becomes known, and its first digit is counted. */
__kernel void countPhotons(__global uint* photons, __global const uint* blocks, __global const RegionCount* regions,
                           __global const uint* tables, __global uint* counts, const SortDigit digit,
                           const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    const size_t stride = params.photonStride;
    __global uint* own = countsOf(chunk, counts, &digit);
    clearCounts(own, &digit);
    const uint end = firstOfChunk(chunk + 1, params.regions, &digit);
    for (uint region = firstOfChunk(chunk, params.regions, &digit); region < end; ++region)
        for (BlockWalk walk = blocksOf(regions + region); walk.left > 0; toNextBlock(&walk, blocks)) {
            __global uint* block = photons + walk.block * PHOTON_BLOCK;
            for (uint k = 0; k < photonsInBlock(&walk); ++k) {
                const uint cell = cellOfTraced(block + k, stride, tables, &params);
                ++*countOf(cell, own, &digit);
                block[PHOTON_CELL * stride + k] = cell;
            }
        }
}

/* From the photons' cells to their order by the first digit. */
__kernel void placePhotons(__global const uint* photons, __global const uint* blocks,
                           __global const RegionCount* regions, __global uint* counts, __global uint* to,
                           const ulong toAt, const SortDigit digit, const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    __global const uint* cells = photons + (size_t)PHOTON_CELL * params.photonStride;
    const uint end = firstOfChunk(chunk + 1, params.regions, &digit);
    for (uint region = firstOfChunk(chunk, params.regions, &digit); region < end; ++region)
        for (BlockWalk walk = blocksOf(regions + region); walk.left > 0; toNextBlock(&walk, blocks)) {
            const uint first = walk.block * PHOTON_BLOCK;
            for (uint k = first; k < first + photonsInBlock(&walk); ++k)
                to[toAt + (*countOf(cells[k], own, &digit))++] = k;
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
