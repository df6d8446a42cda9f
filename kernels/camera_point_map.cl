/* Stage 2 of a pass in the camera map's order: index the camera points by class and cell (cell_sort.clh). */
#include "cell_scan.clh"

#define RECORD CameraPoint
#define RECORD_REGION PointRegionCount

inline uint recordCell(__global const CameraPoint* point, __global const uint* tables, const MapParams* params) {
    return cellOf(point->slotDepth & (PHOTON_SLOTS - 1), load3(point->position), point->place, tables, params);
}

inline void placeRecord(__global const CameraPoint* point, uint index, __global uint* sorted, uint place, uint stride) {
    sorted[(size_t)POINT_X * stride + place] = as_uint(point->position.x);
    sorted[(size_t)POINT_Y * stride + place] = as_uint(point->position.y);
    sorted[(size_t)POINT_Z * stride + place] = as_uint(point->position.z);
    sorted[(size_t)POINT_PLACE * stride + place] = point->place;
    sorted[(size_t)POINT_INDEX * stride + place] = index;
}

#include "cell_sort.clh"
