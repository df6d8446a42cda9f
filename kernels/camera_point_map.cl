/* Stage 2 of a pass in the camera map's order: index the camera points by class and cell. A stable counting sort: each of
 * `chunks` work-items counts, and later scatters, its own run of regions in order; within a cell the points then stand in the
 * order of their regions whatever the number of chunks, so sums over them are reproducible. */
#include "cell_scan.clh"

inline uint cellOfPoint(__global const CameraPoint* point, __global const uint* tables, const MapParams* params) {
    return cellOf(point->slotDepth & (PHOTON_SLOTS - 1), load3(point->position), point->place, tables, params);
}

/* counts[chunk * cells + cell] */
__kernel void countPoints(__global const CameraPoint* points, __global const PointRegionCount* regions,
                          __global const uint* tables, __global uint* counts, const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    const uint cells = cellCount(&params);
    __global uint* own = counts + (size_t)chunk * cells;
    for (uint cell = 0; cell < cells; ++cell) own[cell] = 0;
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region) {
        __global const CameraPoint* first = points + (size_t)region * params.regionCapacity;
        for (uint k = 0; k < regions[region].stored; ++k) ++own[cellOfPoint(first + k, tables, &params)];
    }
}

__kernel void scatterPoints(__global const CameraPoint* points, __global const PointRegionCount* regions,
                            __global const uint* tables, __global uint* counts, __global uint* sorted,
                            const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    __global uint* own = counts + (size_t)chunk * cellCount(&params);
    const size_t stride = params.photonStride;
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region) {
        const size_t first = (size_t)region * params.regionCapacity;
        for (size_t index = first; index < first + regions[region].stored; ++index) {
            __global const CameraPoint* point = points + index;
            __global uint* place = sorted + own[cellOfPoint(point, tables, &params)]++;
            place[POINT_X * stride] = as_uint(point->position.x);
            place[POINT_Y * stride] = as_uint(point->position.y);
            place[POINT_Z * stride] = as_uint(point->position.z);
            place[POINT_PLACE * stride] = point->place;
            place[POINT_INDEX * stride] = index;
        }
    }
}
