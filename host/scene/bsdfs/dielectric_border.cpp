// What borders between two dielectrics have in common, be they smooth, rough or thin.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

DielectricBorder readDielectricBorder(Properties& properties, unsigned lobeType, double halfWidth) {
    DielectricBorder border;
    border.inside = readRefractiveIndex(properties, "int_ior", "bk7");
    border.outside = readRefractiveIndex(properties, "ext_ior", "air");
    border.lobe = makeLobe(lobeType, "specular", readReflectance(properties, "specular_reflectance", 1), halfWidth);
    const Reflectance transmittance = readReflectance(properties, "specular_transmittance", 1);
    border.lobe.device.transmittance = transmittance.scale;
    border.lobe.device.transmittanceTexture = transmittance.texture;
    return border;
}

LobeDescription DielectricBorder::seenFrom(double near, double far) const {
    LobeDescription seen = lobe;
    const float eta = static_cast<float>(far / near);
    seen.device.eta = {eta, eta, eta};
    return seen;
}

BsdfLobes DielectricBorder::bothSides() const {
    BsdfLobes lobes;
    lobes.front.push_back(seenFrom(outside, inside));
    lobes.back.push_back(seenFrom(inside, outside));
    return lobes;
}

} // namespace quasilux
