/* Stage 2 of a pass in the camera map's order: index the camera points by class and cell, as photon_map.cl does photons. */
#include "cell_scan.clh"

inline uint pointCell(__global const CameraPoint* point, __global const uint* tables, const MapParams* params) {
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
        for (uint k = 0; k < regions[region].stored; ++k) ++own[pointCell(first + k, tables, &params)];
    }
}

inline void placePoint(__global const CameraPoint* point, uint index, __global uint* sorted, uint place, uint stride) {
    sorted[(size_t)POINT_X * stride + place] = as_uint(point->position.x);
    sorted[(size_t)POINT_Y * stride + place] = as_uint(point->position.y);
    sorted[(size_t)POINT_Z * stride + place] = as_uint(point->position.z);
    sorted[(size_t)POINT_PLACE * stride + place] = point->place;
    sorted[(size_t)POINT_INDEX * stride + place] = index;
}

__kernel void scatterPoints(__global const CameraPoint* points, __global const PointRegionCount* regions,
                            __global const uint* tables, __global uint* counts, __global uint* sorted,
                            const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= params.chunks) return;
    __global uint* own = counts + (size_t)chunk * cellCount(&params);
    for (uint region = chunkRegion(chunk, &params); region < chunkRegion(chunk + 1, &params); ++region) {
        const uint first = region * params.regionCapacity;
        for (uint k = 0; k < regions[region].stored; ++k)
            placePoint(points + first + k, first + k, sorted, own[pointCell(points + first + k, tables, &params)]++,
                       params.photonStride);
    }
}
