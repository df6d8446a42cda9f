// The density estimate's sums as a plain C++ loop over the render's sorted photons.
#pragma once

#include "micro/gather_types.h"
#include "pass_types.h"

#include <cstddef>
#include <cstdint>

namespace quasilux {

struct NativeMap {
    const uint32_t* sorted = nullptr;
    const uint32_t* cellStart = nullptr;
    shared::MapParams map{};
};

/// Sums for `count` queries; with `bias`, those of the estimate of bias too.
void gatherLoop(const NativeMap& photons, const shared::GatherQuery* queries, shared::GatherSum* sums, size_t count,
                bool bias);

/// Photons in the cells about a query: what is tested for lying in range.
uint64_t photonsTested(const NativeMap& photons, const shared::GatherQuery* queries, size_t count);

} // namespace quasilux
