// <bsdf type="roughconductor">: a metal or mirror of microfacets.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

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
