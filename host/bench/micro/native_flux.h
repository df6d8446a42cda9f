// The codes of kernels/packed_flux.clh, for native loops over the same arrays.
#pragma once

#include "shared_types.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace quasilux {

constexpr float packedFluxScale = 0x1p96f;
constexpr uint32_t nearestCode = 1u << 17; ///< `random` with which a channel is rounded to the nearest code

/// A channel from 2^-30 to 2 as a code of `bits` bits, rounded up in proportion to `random`, below 2^18.
inline uint32_t nativePackChannel(float value, unsigned bits, uint32_t random) {
    const unsigned dropped = 28 - bits;
    const uint32_t code = (std::bit_cast<uint32_t>(value / packedFluxScale) + (random >> (18 - dropped))) >> dropped;
    return value > 0 ? std::min(code, (1u << bits) - 1) : 0;
}

inline uint32_t nativePackFlux(const shared::Rgb& flux, uint32_t random) {
    return nativePackChannel(flux.r, 11, random) | nativePackChannel(flux.g, 11, random) << 11 |
           nativePackChannel(flux.b, 10, random) << 22;
}

inline shared::Rgb nativeUnpackFlux(uint32_t flux) {
    return {std::bit_cast<float>(flux << 17 & 0x0ffe0000u) * packedFluxScale,
            std::bit_cast<float>(flux << 6 & 0x0ffe0000u) * packedFluxScale,
            std::bit_cast<float>(flux >> 4 & 0x0ffc0000u) * packedFluxScale};
}

} // namespace quasilux
