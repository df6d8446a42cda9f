// Microfacet parameters of the rough bsdfs.
#include "scene/bsdfs/bsdf_plugin.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double smallestAlpha = 1e-4; // below, single precision cannot hold the distribution

float readAlpha(Properties& properties, const std::string& name, double missing, const std::string& smooth) {
    const double alpha = properties.number(name, missing);
    if (alpha < smallestAlpha)
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; it must be at least {}. For a smooth surface use <bsdf "
                                     "type=\"{}\">.",
                                     name, alpha, smallestAlpha, smooth));
    return static_cast<float>(alpha);
}

} // namespace

double Roughness::halfWidth() const {
    const double widest = std::max(alphaU, alphaV);
    return ggx ? ggxHalfWidth(widest) : beckmannHalfWidth(widest);
}

Roughness readRoughness(Properties& properties, const std::string& smooth) {
    const bool anisotropic = properties.has("alpha_u") || properties.has("alpha_v");
    if (anisotropic && (properties.has("alpha") || !properties.has("alpha_u") || !properties.has("alpha_v")))
        throw InputError(properties.where("alpha_u"), fmt::format("{}: give either alpha, or both alpha_u and alpha_v.",
                                                                  properties.element().get("type")));
    const float alpha = readAlpha(properties, "alpha", 0.1, smooth);
    Roughness roughness;
    roughness.ggx = properties.choice("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx";
    roughness.alphaU = readAlpha(properties, "alpha_u", alpha, smooth);
    roughness.alphaV = readAlpha(properties, "alpha_v", alpha, smooth);
    properties.accept({"sample_visible"});
    return roughness;
}

} // namespace quasilux
