// <bsdf type="roughdielectric">: a border of microfacets between two transparent materials, such as ground glass.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

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

} // namespace quasilux
