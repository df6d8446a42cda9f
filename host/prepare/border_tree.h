// Tree over the border segments, in which density estimates find those that cut their disc (kernels/border_tree.clh).
#pragma once

#include "prepare/borders.h"

namespace quasilux {

struct BorderTree {
    std::vector<shared::BorderNode> nodes; ///< depth first, node 0 the root; none where there is no segment
    std::vector<shared::BorderLeaf> leaves;
    size_t segmentCount = 0;
    std::vector<unsigned>
        nodeOfPatch; ///< the lowest node that holds all segments whose patchA it is; QL_NONE: there are none
};

/// Binary tree: segments of different patches are parted first, those of one patch by their places.
BorderTree buildBorderTree(const std::vector<BorderSegment>& segments, unsigned patchCount);

} // namespace quasilux
