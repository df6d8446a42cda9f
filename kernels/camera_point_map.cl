/* Stage 2 of a pass in the camera map's order: index the camera points by class and cell. Here they get their
 * cells; record_sort.cl sorts them. */
#include "cell_sort.clh"
#include "record_cell.clh"

/* Each point's cell becomes known, and its first digit is counted. */
__kernel void countPoints(__global CameraPoint* points, __global const PointRegionCount* regions,
                          __global const uint* tables, __global uint* counts, const SortDigit digit,
                          const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    clearCounts(own, &digit);
    const uint end = firstOfChunk(chunk + 1, params.regions, &digit);
    for (uint region = firstOfChunk(chunk, params.regions, &digit); region < end; ++region) {
        __global CameraPoint* point = points + (size_t)region * params.regionCapacity;
        for (uint k = 0; k < regions[region].stored; ++k, ++point) {
            point->cell =
                cellOf(point->slotDepth & (PHOTON_SLOTS - 1), load3(point->position), point->place, tables, &params);
            ++*countOf(point->cell, own, &digit);
        }
    }
}
