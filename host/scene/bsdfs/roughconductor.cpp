// <bsdf type="roughconductor">: a metal or mirror of microfacets.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readRoughConductor(Properties& properties) {
    const Roughness roughness = readRoughness(properties, "conductor");
    LobeDescription lobe = makeLobe(roughness.ggx ? LOBE_GGX : LOBE_BECKMANN, "specular",
                                    readReflectance(properties, "specular_reflectance", 1), roughness.halfWidth());
    lobe.device.alphaU = roughness.alphaU;
    lobe.device.alphaV = roughness.alphaV;
    readConductorIndex(properties, lobe.device);
    BsdfLobes lobes;
    lobes.front.push_back(lobe);
    return lobes;
}

} // namespace quasilux
