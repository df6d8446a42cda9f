// The cells of kernels/photon_grid.clh, for native loops over the same arrays.
#pragma once

#include "pass_types.h"

#include <cmath>

namespace quasilux {

struct CellCoordinate {
    int x, y, z;
};

inline CellCoordinate nativeCoordinate(const shared::Packed3& p, float radius) {
    return {int(std::floor(p.x / radius)), int(std::floor(p.y / radius)), int(std::floor(p.z / radius))};
}

inline unsigned nativeCell(const CellCoordinate& c, unsigned patchSide, unsigned cellMask) {
    const unsigned z = unsigned(c.z) + patchSide * 0xb5297a4du;
    unsigned hash = unsigned(c.y) * 0x8da6b343u ^ z * 0xd8163841u;
    hash ^= hash >> 15;
    hash *= 0x2c1b3c6du;
    return ((hash ^ hash >> 12) + unsigned(c.x)) & cellMask;
}

/// Places of fields in the sorted arrays, as PHOTON_* of kernels/photon_grid.clh.
enum PhotonField { fieldX, fieldY, fieldZ, fieldFlux, fieldPatchSide, fieldDirection };

} // namespace quasilux
