// <bsdf type="roughconductor">: a metal or mirror of microfacets.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double smallestAlpha = 1e-4; // below, single precision cannot hold the distribution

float readAlpha(Properties& properties, const std::string& name, double missing) {
    const double alpha = properties.number(name, missing);
    if (alpha < smallestAlpha)
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; it must be at least {}. For a smooth "
                                     "mirror use <bsdf type=\"conductor\">.",
                                     name, alpha, smallestAlpha));
    return static_cast<float>(alpha);
}

} // namespace

BsdfLobes readRoughConductor(Properties& properties) {
    const bool anisotropic = properties.has("alpha_u") || properties.has("alpha_v");
    if (anisotropic && (properties.has("alpha") || !properties.has("alpha_u") || !properties.has("alpha_v")))
        throw InputError(properties.where("alpha_u"),
                         "roughconductor: give either alpha, or both alpha_u and alpha_v.");
    const float alpha = readAlpha(properties, "alpha", 0.1);
    const bool ggx = properties.choice("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx";
    LobeDescription lobe =
        makeLobe(ggx ? LOBE_GGX : LOBE_BECKMANN, "specular", readReflectance(properties, "specular_reflectance", 1), 0);
    lobe.device.alphaU = readAlpha(properties, "alpha_u", alpha);
    lobe.device.alphaV = readAlpha(properties, "alpha_v", alpha);
    const double widest = std::max(lobe.device.alphaU, lobe.device.alphaV);
    lobe.halfWidth = ggx ? ggxHalfWidth(widest) : beckmannHalfWidth(widest);
    readConductorIndex(properties, lobe.device);
    properties.accept({"sample_visible"});
    BsdfLobes lobes;
    lobes.front.push_back(lobe);
    return lobes;
}

} // namespace quasilux
