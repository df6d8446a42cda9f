// <bsdf type="thindielectric">: a pane so thin that light passes without a shift.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readThinDielectric(Properties& properties) {
    const double inside = readRefractiveIndex(properties, "int_ior", "bk7");
    const double outside = readRefractiveIndex(properties, "ext_ior", "air");
    LobeDescription lobe =
        makeLobe(LOBE_THINDIELECTRIC, "specular", readReflectance(properties, "specular_reflectance", 1), 0);
    const Reflectance transmittance = readReflectance(properties, "specular_transmittance", 1);
    lobe.device.transmittance = transmittance.scale;
    lobe.device.transmittanceTexture = transmittance.texture;
    lobe.device.scattering = SCATTER_SPECULAR;
    const float eta = static_cast<float>(inside / outside);
    lobe.device.eta = {eta, eta, eta};
    BsdfLobes lobes;
    lobes.front.push_back(lobe);
    lobes.back.push_back(lobe);
    return lobes;
}

} // namespace quasilux
