// All pairs of boxes that overlap.
#pragma once

#include "scene/box.h"

#include <functional>
#include <vector>

namespace quasilux {

/// Calls visit(i, j) with i < j once for every two overlapping boxes, in an order that depends on the boxes alone.
/// O(n log n + pairs) also where sizes differ widely: a tree of boxes is walked against itself.
void forEachOverlappingPair(const std::vector<Box>& boxes, const std::function<void(unsigned, unsigned)>& visit);

} // namespace quasilux
