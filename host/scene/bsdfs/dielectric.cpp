// Borders between two transparent materials: smooth, rough or thin.
#include "scene/bsdfs/bsdf_plugin.h"

#include <cmath>

namespace quasilux {

/// What borders between two dielectrics have in common, be they smooth, rough or thin.
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

/// <bsdf type="dielectric">: a smooth border between two transparent materials.
BsdfLobes readDielectric(Properties& properties) {
    DielectricBorder border = readDielectricBorder(properties, LOBE_DIELECTRIC, 0);
    border.lobe.device.scattering = SCATTER_SPECULAR;
    if (border.inside == border.outside)
        properties.context().warn(
            properties.element().where,
            "dielectric: int_ior and ext_ior are equal, so it bends no light; <bsdf type=\"null\"> is faster.");
    return border.bothSides();
}

/// <bsdf type="roughdielectric">: a border of microfacets between two transparent materials, such as ground glass.
BsdfLobes readRoughDielectric(Properties& properties) {
    const Roughness roughness = readRoughness(properties, "dielectric", true);
    DielectricBorder border = readDielectricBorder(
        properties, roughness.ggx ? LOBE_GGXDIELECTRIC : LOBE_BECKMANNDIELECTRIC, roughness.halfWidth());
    if (border.inside == border.outside)
        throw InputError(properties.where("int_ior"),
                         "roughdielectric: int_ior and ext_ior are equal, so its microfacets bend no light; use <bsdf "
                         "type=\"null\">.");
    roughness.applyTo(border.lobe);
    return border.bothSides();
}

/// <bsdf type="thindielectric">: a pane so thin that light passes without a shift.
BsdfLobes readThinDielectric(Properties& properties) {
    DielectricBorder border = readDielectricBorder(properties, LOBE_THINDIELECTRIC, 0);
    border.lobe.device.scattering = SCATTER_SPECULAR;
    BsdfLobes lobes;
    lobes.front.push_back(border.seenFrom(border.outside, border.inside)); // the same pane from either side
    lobes.back.push_back(border.seenFrom(border.outside, border.inside));
    return lobes;
}

} // namespace quasilux
