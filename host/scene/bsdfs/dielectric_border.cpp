// What borders between two dielectrics have in common, be they smooth, rough or thin.
#include "scene/bsdfs/bsdf_plugin.h"

#include <cmath>

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

double dielectricReflectance(double cosine, double eta) {
    const double squared = eta * eta - 1 + cosine * cosine;
    if (squared <= 0) return 1;
    const double g = std::sqrt(squared);
    const double rs = (cosine - g) / (cosine + g), rp = (eta * eta * cosine - g) / (eta * eta * cosine + g);
    return (rs * rs + rp * rp) / 2;
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
