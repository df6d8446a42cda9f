/* Stage 2 of a pass: index the photons by class and cell (cell_sort.clh). */
#include "cell_scan.clh"

#define RECORD Photon
#define RECORD_REGION RegionCount

inline uint recordCell(__global const Photon* photon, __global const uint* tables, const MapParams* params) {
    return cellOf(photon->classDepth & (PHOTON_SLOTS - 1), load3(photon->position), photon->patchSide, tables, params);
}

inline void placeRecord(__global const Photon* photon, uint index, __global uint* sorted, uint place, uint stride) {
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

#include "cell_sort.clh"
