// Roughness by texture, and what else lobes are not linear in: a lobe for each level of it, so that the kernels sample
// and evaluate lobes as ever.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// The levels of one side's lobes.
struct SideLevels {
    shared::RoughnessLevels device{};
    std::vector<LevelTexture> textures; ///< those of the record

    /// Of all combinations.
    unsigned count() const { return device.levels[0] * device.levels[1] * device.levels[2]; }
    /// `lobe`, of this description, at one of the combinations, which the last texture counts fastest.
    shared::Lobe lobeAt(unsigned combination, shared::Lobe lobe, const LobeDescription& description) const;
};

/// Of the lobes of one side, or nullopt where none has such a texture. Throws InputError where they have too many
/// different ones.
std::optional<SideLevels> roughnessLevels(const Scene& scene, const Bsdf& bsdf,
                                          const std::vector<LobeDescription>& side);

} // namespace quasilux
