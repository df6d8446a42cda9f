// <bsdf type="roughplastic">: a diffuse base under a coat of microfacets.
#include "scene/bsdfs/bsdf_plugin.h"
#include "scene/bsdfs/rough_coat.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

LobeDescription coatLobe(Properties& properties, const Roughness& roughness, double eta) {
    LobeDescription lobe = makeLobe(roughness.ggx ? LOBE_GGX : LOBE_BECKMANN, "specular",
                                    readReflectance(properties, "specular_reflectance", 1), roughness.halfWidth());
    lobe.device.alphaU = lobe.device.alphaV = roughness.alphaU;
    const auto index = static_cast<float>(eta);
    lobe.device.eta = {index, index, index}; // without absorption: a dielectric's reflectance
    lobe.device.k = {0, 0, 0};
    return lobe;
}

LobeDescription baseLobe(const CoatedBase& base, const RoughCoat& coat) {
    LobeDescription lobe = base.lobe(LOBE_ROUGHCOATEDLAMBERT, coat.eta, coat.internalReflectance());
    const CoatFit fit = fitTransmission(coat);
    for (size_t k = 0; k < fit.factors.size(); ++k) lobe.device.coat[k] = static_cast<float>(fit.factors[k]);
    lobe.device.alphaU = static_cast<float>(fit.knee);
    lobe.device.alphaV = static_cast<float>(fit.edge);
    if (fit.edge != 0)
        lobe.device.eta = {static_cast<float>(fit.eta), static_cast<float>(fit.scale), static_cast<float>(fit.offset)};
    lobe.device.exponent = static_cast<float>(fit.ofDiffuseLight());
    return lobe;
}

} // namespace

BsdfLobes readRoughPlastic(Properties& properties) {
    const double inside = readRefractiveIndex(properties, "int_ior", "polypropylene");
    const double outside = readRefractiveIndex(properties, "ext_ior", "air");
    if (inside == outside)
        throw InputError(
            properties.where("int_ior"),
            fmt::format("roughplastic: int_ior is {}, as ext_ior; a coat must have another index than what "
                        "is outside; without a coat it is <bsdf type=\"diffuse\">.",
                        inside));
    const Roughness roughness = readRoughness(properties, "plastic", false);
    if (roughness.alphaU != roughness.alphaV)
        throw InputError(properties.where("alpha_u"),
                         "roughplastic: alpha_u and alpha_v differ; its coat is isotropic, so give alpha.");
    const CoatedBase base = readCoatedBase(properties);
    const RoughCoat coat{roughness.ggx, roughness.alphaU, inside / outside};
    BsdfLobes lobes;
    lobes.front = {baseLobe(base, coat), coatLobe(properties, roughness, coat.eta)};
    return lobes;
}

} // namespace quasilux
