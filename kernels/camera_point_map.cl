/* Stage 2 of a pass in the camera map's order: index the camera points by class and cell. */
#include "cell_sort.clh"

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

/* From the points' cells to their order by the first digit. */
__kernel void placePoints(__global const CameraPoint* points, __global const PointRegionCount* regions,
                          __global uint* counts, __global uint* to, const ulong toAt, const SortDigit digit,
                          const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    const uint end = firstOfChunk(chunk + 1, params.regions, &digit);
    for (uint region = firstOfChunk(chunk, params.regions, &digit); region < end; ++region) {
        const size_t first = (size_t)region * params.regionCapacity;
        for (size_t index = first; index < first + regions[region].stored; ++index)
            to[toAt + (*countOf(points[index].cell, own, &digit))++] = index;
    }
}

/* The fields that finding points takes, in their order. */
__kernel void gatherPoints(__global const CameraPoint* points, __global uint* sorted, const uint count,
                           const MapParams params) {
    const uint place = get_global_id(0);
    if (place >= count) return;
    const size_t stride = params.photonStride;
    __global uint* to = sorted + place;
    __global const CameraPoint* point = points + to[POINT_INDEX * stride];
    to[POINT_X * stride] = as_uint(point->position.x);
    to[POINT_Y * stride] = as_uint(point->position.y);
    to[POINT_Z * stride] = as_uint(point->position.z);
    to[POINT_PLACE * stride] = point->place;
}
