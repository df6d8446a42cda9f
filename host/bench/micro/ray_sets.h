// The rays that a render of a scene sends, in sets of one kind.
#pragma once

#include "bench/micro/embree_scene.h"
#include "bench/micro/scenes.h"

namespace quasilux {

/// Each holds a multiple of 16 rays. Neighbours lie close together in the coherent sets.
struct RaySets {
    std::vector<MicroRay>
        primary; ///< through pixels, by tiles of 8 x 8, of which 16 in turn are 4 x 4, and 8 are 4 x 2
    std::vector<MicroRay> ordered; ///< cosine-distributed from the hits of the primary rays, in their order
    std::vector<MicroRay> random;  ///< the same, shuffled
    std::vector<MicroRay> shadow;  ///< from these hits to random points of the lamp
};

RaySets makeRaySets(const MicroScene& scene, const EmbreeScene& embree, size_t rays);

} // namespace quasilux
