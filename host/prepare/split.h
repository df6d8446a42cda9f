// Which lobes are genuine diffuse and which quasi-specular: the one choice that the method leaves to its user. Any choice
// gives the same mean image (kernels/law.clh); only the noise differs.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace quasilux {

/// `auto` follows lobes whose half width (half of the energy lies within) is below this angle: 15 degrees.
inline constexpr double quasiSpecularHalfWidth = 0.2617993877991494;

struct LobeDecision {
    unsigned scattering = 0; ///< SCATTER_*
    std::string why;
};

/// Decisions for every lobe of a bsdf, in the order front, back.
struct BsdfDecision {
    std::vector<LobeDecision> front, back;
};

/// `setting` is auto | none | all | ID,ID,… where ID names a bsdf (its lobes other than Lambert, or all if it has no
/// other) or ID.LOBE one lobe of it. With `overridesScene` it wins over what the bsdfs of the scene say.
/// Throws InputError for an ID that the scene does not have.
std::vector<BsdfDecision> decideSplit(const Scene& scene, const std::string& setting, bool overridesScene);

} // namespace quasilux
