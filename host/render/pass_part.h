// Photons of a pass that the device has no room for come in several parts, one after the other.
#pragma once

#include <cstdint>

namespace quasilux {

/// Each part has its share of the photons, which carry all flux between them, and camera paths of its own; the estimate
/// of the pass is the mean of its parts'.
struct PassPart {
    unsigned number = 0, count = 1;

    bool isFirst() const { return number == 0; }
    bool isLast() const { return number + 1 == count; }
    bool isWhole() const { return count == 1; }
    /// What stands for the seed in the part's random numbers: no pass has those of another one, in however many parts
    /// both come, so all may be added up; nor those of pilots, whose seed is moved by another number
    /// (host/auto/search.cpp).
    uint64_t seedOf(uint64_t seed) const { return seed ^ number * 0xD1B54A32D192ED03u; }
    /// Of the paths of a pass.
    unsigned share(unsigned paths) const { return static_cast<unsigned>((uint64_t{paths} + count - 1) / count); }
};

} // namespace quasilux
