/* Stage 2 of a pass: index the photons by class and cell, in the arrays that they were traced into
 * (photon_store.clh). Here they get their cells; record_sort.cl sorts them. */
#include "cell_sort.clh"
#include "photon_store.clh"
#include "record_cell.clh"

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
