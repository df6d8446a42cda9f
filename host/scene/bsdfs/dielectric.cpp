// <bsdf type="dielectric">: a smooth border between two transparent materials.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readDielectric(Properties& properties) {
    const double inside = readRefractiveIndex(properties, "int_ior", "bk7");
    const double outside = readRefractiveIndex(properties, "ext_ior", "air");
    LobeDescription lobe =
        makeLobe(LOBE_DIELECTRIC, "specular", readReflectance(properties, "specular_reflectance", 1), 0);
    const Reflectance transmittance = readReflectance(properties, "specular_transmittance", 1);
    lobe.device.transmittance = transmittance.scale;
    lobe.device.transmittanceTexture = transmittance.texture;
    lobe.device.scattering = SCATTER_SPECULAR;
    if (inside == outside)
        properties.context().warn(
            properties.element().where,
            "dielectric: int_ior and ext_ior are equal, so it bends no light; <bsdf type=\"null\"> is faster.");
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
