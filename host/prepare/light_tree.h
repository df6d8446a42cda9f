// A balanced binary tree over emitters, by which one of many is chosen for a place (kernels/light_tree.clh).
#pragma once

#include "prepare/device_scene.h"

namespace quasilux {

struct LightTree {
    std::vector<unsigned> order;          ///< in which the emitters are to lie
    std::vector<shared::LightNode> nodes; ///< 2 n - 1 of n emitters, as LightNode says
};

/// Of emitters in the scene, none of them distant: each node is cut at the median along the longest side of its
/// emitters' bounds.
LightTree buildLightTree(const EmitterTables& emitters);

} // namespace quasilux
