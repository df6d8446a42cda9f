// Metals and mirrors, smooth and rough. Their indices of refraction: conductor_index.cpp.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

/// <bsdf type="conductor">: a smooth metal or mirror.
BsdfLobes readConductor(Properties& properties) {
    LobeDescription lobe =
        makeLobe(LOBE_CONDUCTOR, "specular", readReflectance(properties, "specular_reflectance", 1), 0);
    lobe.device.scattering = SCATTER_SPECULAR;
    readConductorIndex(properties, lobe.device);
    BsdfLobes lobes;
    lobes.front.push_back(lobe);
    return lobes;
}

/// <bsdf type="roughconductor">: a metal or mirror of microfacets.
BsdfLobes readRoughConductor(Properties& properties) {
    const Roughness roughness = readRoughness(properties, "conductor", true);
    LobeDescription lobe = makeLobe(roughness.ggx ? LOBE_GGX : LOBE_BECKMANN, "specular",
                                    readReflectance(properties, "specular_reflectance", 1), roughness.halfWidth());
    roughness.applyTo(lobe);
    readConductorIndex(properties, lobe.device);
    BsdfLobes lobes;
    lobes.front.push_back(lobe);
    return lobes;
}

} // namespace quasilux
