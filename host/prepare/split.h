// Which lobes, and which part of a phase function, are genuine diffuse and which quasi-specular: the one choice that
// the method leaves to its user. Any choice gives the same mean image (kernels/law.clh); only the noise differs.
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

/// `setting` is auto | none | all | level:NUMBER (as auto) | ID,ID,… where ID names a bsdf (its lobes other than
/// Lambert, or all if it has no other), ID.LOBE one lobe of it, or ID a medium (no lobe). With `overridesScene` it wins
/// over what the bsdfs of the scene say. Throws InputError for an ID that the scene does not have.
std::vector<BsdfDecision> decideSplit(const Scene& scene, const std::string& setting, bool overridesScene);

/// How a medium's phase function is split (shared::Medium::level).
struct MediumDecision {
    float level = 0;                ///< sr^-1: genuine diffuse = min(p, level); 0: none of it, infinity: all of it
    double genuineDiffuseShare = 0; ///< of the scattering: integral of min(p, level) over the sphere
    std::string why;
};

/// The level of phase function that `auto` chooses: 5/4 of an isotropic one's value, 1/(4 pi).
inline constexpr double autoPhaseLevel = 0.1;
/// Where more than this share of the scattering lies below that level, `auto` takes all of it as genuine diffuse.
inline constexpr double autoDiffuseShare = 0.95;

/// Decisions for Scene::media. `setting` as above: none is level infinity, all is level 0, `level:0.1` that level for
/// every medium; a list makes all of the phase function quasi-specular where it names the medium, and is auto for the
/// others. A level that the phase function nowhere exceeds becomes infinity. `overridesScene` as above; throws alike.
std::vector<MediumDecision> decideMediumSplit(const Scene& scene, const std::string& setting, bool overridesScene);

} // namespace quasilux
