// Roughness by texture: a lobe for each level of it, so that the kernels sample and evaluate lobes as ever.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// Of the lobes of one side, or nullopt where none has such a texture. Throws InputError where they have different ones.
std::optional<shared::RoughnessLevels> roughnessLevels(const Scene& scene, const Bsdf& bsdf,
                                                       const std::vector<LobeDescription>& side);

/// `lobe`, of this description, at a pair of levels.
shared::Lobe lobeAtLevel(shared::Lobe lobe, const LobeDescription& description, const shared::RoughnessLevels& levels,
                         unsigned levelU, unsigned levelV);

} // namespace quasilux
