// The diffuse base of <bsdf type="plastic|roughplastic">, seen through its coat.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

CoatedBase readCoatedBase(Properties& properties) {
    CoatedBase base{readReflectance(properties, "diffuse_reflectance", 0.5f), properties.boolean("nonlinear", false)};
    if (base.nonlinear && base.reflectance.texture != 0)
        throw InputError(properties.where("nonlinear"),
                         fmt::format("{}: the colour shift of nonlinear needs one colour, and diffuse_reflectance is a "
                                     "texture; give it as <rgb>, or leave nonlinear out.",
                                     properties.plugin()));
    return base;
}

LobeDescription CoatedBase::lobe(unsigned type, double eta, double sentBack) const {
    LobeDescription lobe = makeLobe(type, "diffuse", reflectance, lambertHalfWidth);
    const auto seen = [&](float ofBase) {
        return static_cast<float>(ofBase / (eta * eta * (1 - (nonlinear ? ofBase : 1) * sentBack)));
    };
    Rgb& scale = lobe.device.reflectance;
    scale = {seen(scale.r), seen(scale.g), seen(scale.b)};
    return lobe;
}

} // namespace quasilux
