// An image of the surroundings as the kernels take it: its pixels, and the probabilities by which directions are
// sampled (kernels/emitters/envmap.clh).
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace quasilux {

struct EnvironmentTable {
    std::vector<uint32_t> words; ///< a shared::EnvironmentMap and what it has
    Rgb meanRadiance{};          ///< over the sphere
    double radianceByFlux = 0;   ///< mean of R, G, B, weighted by what comes from where
};
EnvironmentTable makeEnvironmentTable(const EnvironmentImage& image);

} // namespace quasilux
