// <bsdf type="dielectric">: a smooth border between two transparent materials.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

BsdfLobes readDielectric(Properties& properties) {
    DielectricBorder border = readDielectricBorder(properties, LOBE_DIELECTRIC, 0);
    border.lobe.device.scattering = SCATTER_SPECULAR;
    if (border.inside == border.outside)
        properties.context().warn(
            properties.element().where,
            "dielectric: int_ior and ext_ior are equal, so it bends no light; <bsdf type=\"null\"> is faster.");
    return border.bothSides();
}

} // namespace quasilux
