// <bsdf type="roughdielectric">: a border of microfacets between two transparent materials, such as ground glass.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readRoughDielectric(Properties& properties) {
    const double inside = readRefractiveIndex(properties, "int_ior", "bk7");
    const double outside = readRefractiveIndex(properties, "ext_ior", "air");
    if (inside == outside)
        throw InputError(properties.where("int_ior"),
                         "roughdielectric: int_ior and ext_ior are equal, so its microfacets bend no light; use <bsdf "
                         "type=\"null\">.");
    const Roughness roughness = readRoughness(properties, "dielectric");
    LobeDescription lobe = makeLobe(roughness.ggx ? LOBE_GGXDIELECTRIC : LOBE_BECKMANNDIELECTRIC, "specular",
                                    readReflectance(properties, "specular_reflectance", 1), roughness.halfWidth());
    const Reflectance transmittance = readReflectance(properties, "specular_transmittance", 1);
    lobe.device.transmittance = transmittance.scale;
    lobe.device.transmittanceTexture = transmittance.texture;
    lobe.device.alphaU = roughness.alphaU;
    lobe.device.alphaV = roughness.alphaV;
    // The index on the far side relative to the one on the side that light is seen from.
    const auto seenFrom = [&](double near, double far) {
        const float eta = static_cast<float>(far / near);
        lobe.device.eta = {eta, eta, eta};
        return lobe;
    };
    BsdfLobes lobes;
    lobes.front.push_back(seenFrom(outside, inside));
    lobes.back.push_back(seenFrom(inside, outside));
    return lobes;
}

} // namespace quasilux
