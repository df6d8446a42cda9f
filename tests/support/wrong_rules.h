// Known mistakes, as negative controls: what the kernels hold of them is switched on by RenderSettings::controlOptions.
#pragma once

#include <fmt/format.h>
#include <string>

namespace quasilux::test {

/// The law, or one of its known wrong readings (kernels/law.clh).
enum class LawRule { right, quasiSpecularUntilFirst, diffuseAtEveryHit, fullAlongChain };

/// The right handling of media, or one of the known mistakes: flux at collisions not divided by the extinction;
/// refracted radiance not scaled by 1/eta^2; the phase function's g of the wrong sign where photons are taken; flux in
/// a heterogeneous medium divided by the mean of its extinction; what a border of media passes through is in vacuum;
/// camera rays begin before the near plane, at the pinhole; photons far outside that survive roulette do not carry the
/// flux of those that it ended; density kernels end at null surfaces with the same medium on both sides.
enum class MediumRule {
    right,
    missingSigmaT,
    missingEtaSquared,
    wrongSignOfG,
    meanSigmaT,
    vacuumAtBorders,
    pinhole,
    lossOutside,
    cutWithinFog,
};

/// The right tracing of photons, or a known mistake: flux that escapes is not counted in the energy balance; scattering
/// multiplies flux by 1.02; shading normals are taken for the geometry's where photons scatter, or where they are
/// stored; guided photons do not carry the weight of their leaf, aimed ones not that of their direction; those into
/// which one is split are worth nearly four times their share.
enum class PhotonRule {
    right,
    escapeNotCounted,
    scatteringGains,
    missingAdjoint,
    missingArrival,
    missingGuideWeight,
    missingAimWeight,
    missingSplitWeight,
    missingStoreWeight
};

/// Camera paths of a pixel, or a mistake: the path that gathers for all counts as if there were four; or it is the
/// first one, whose numbers are every fourth, eighth, ... of a sequence; emission that a path meets is weighed by the
/// choice of emitters at its next event.
enum class SamplingRule { right, fourEverywhere, firstGathers, nextChoice };

/// Surfaces, or a mistake: axes of anisotropic lobes follow from the normal alone; textures of eta and of k change
/// places; where textures say the index, Fresnel's factor is that of the normal instead of the facet; roughness by
/// texture is at its first level everywhere; shadow rays are as long behind a surface that they pass as if it had not
/// moved them.
enum class SurfaceRule { right, axesByNormal, etaIsK, fresnelOfNormal, firstLevel, movedShadows };

/// Samples of a sky, or a mistake: directions of lobes are weighed against the density of the other map of it.
enum class SkyRule { right, otherDensity };

/// A pass in several parts, or a mistake: errors are estimated from the last part alone.
enum class PartsRule { right, lastAlone };

/// Compiler options; none where it is the right one.
inline std::string optionOf(LawRule rule) {
    return rule == LawRule::right ? "" : fmt::format(" -DLAW_RULE={}", static_cast<int>(rule));
}
inline std::string optionOf(MediumRule rule) {
    return rule == MediumRule::right ? "" : fmt::format(" -DMEDIUM_RULE={}", static_cast<int>(rule));
}
inline std::string optionOf(SamplingRule rule) {
    return rule == SamplingRule::right ? "" : fmt::format(" -DSAMPLING_RULE={}", static_cast<int>(rule));
}
inline std::string optionOf(PartsRule rule) {
    return rule == PartsRule::right ? "" : fmt::format(" -DPARTS_RULE={}", static_cast<int>(rule));
}
inline std::string optionOf(SurfaceRule rule) {
    return rule == SurfaceRule::right ? "" : fmt::format(" -DSURFACE_RULE={}", static_cast<int>(rule));
}
inline std::string optionOf(SkyRule rule) {
    return rule == SkyRule::right ? "" : fmt::format(" -DSKY_RULE={}", static_cast<int>(rule));
}
inline std::string optionOf(PhotonRule rule) {
    return rule == PhotonRule::right ? "" : fmt::format(" -DPHOTON_RULE={}", static_cast<int>(rule));
}

} // namespace quasilux::test
