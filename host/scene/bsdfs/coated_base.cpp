// The diffuse base of <bsdf type="plastic|roughplastic">, seen through its coat.
#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

CoatedBase readCoatedBase(Properties& properties) {
    return {readReflectance(properties, "diffuse_reflectance", 0.5f), properties.boolean("nonlinear", false)};
}

LobeDescription CoatedBase::lobe(unsigned type, double eta, double sentBack) const {
    LobeDescription lobe = makeLobe(type, "diffuse", reflectance, lambertHalfWidth);
    const bool byTexture = nonlinear && reflectance.texture != 0; // 1 / (1 - texture sentBack) then is a weight
    if (byTexture) {
        lobe.weights.push_back(weightBy(reflectance.texture - 1, 1, -sentBack));
        lobe.weights.back().function = WEIGHT_RECIPROCAL;
    }
    const auto seen = [&](float ofBase) {
        const double again = byTexture ? 1 : 1 - (nonlinear ? ofBase : 1) * sentBack;
        return static_cast<float>(ofBase / (eta * eta * again));
    };
    Rgb& scale = lobe.device.reflectance;
    scale = {seen(scale.r), seen(scale.g), seen(scale.b)};
    return lobe;
}

} // namespace quasilux
