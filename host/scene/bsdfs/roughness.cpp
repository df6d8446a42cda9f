// Microfacet parameters of the rough bsdfs.
#include "scene/bsdfs/bsdf_plugin.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double smallestAlpha = 1e-4; // as in Mitsuba: below, single precision cannot hold the distribution
constexpr float defaultAlpha = 0.1f;

float readAlpha(Properties& properties, const std::string& name, const std::string& smooth) {
    const double alpha = properties.textureNumber(name, defaultAlpha);
    if (alpha < 0)
        throw InputError(properties.where(name),
                         fmt::format("parameter '{}' is {}; it must be at least 0.", name, alpha));
    if (alpha < smallestAlpha)
        properties.context().warn(
            properties.where(name),
            fmt::format("parameter '{}' is {}, which is taken as {}. A smooth surface has less noise "
                        "as <bsdf type=\"{}\">.",
                        name, alpha, smallestAlpha, smooth));
    return static_cast<float>(std::max(alpha, smallestAlpha));
}

/// Of a texture its index and the mean.
Scalar readAlphaOrTexture(Properties& properties, const std::string& name, const std::string& smooth, bool byTexture) {
    const Element* texture = byTexture ? properties.texture(name) : nullptr;
    if (!texture) return {readAlpha(properties, name, smooth), std::nullopt};
    const unsigned index = useScalarTexture(*texture, properties.context());
    const Scene& scene = properties.context().scene;
    return {std::max(meanOfNumbers(scene.textures[index], scene, defaultAlpha), static_cast<float>(smallestAlpha)),
            index};
}

} // namespace

double Roughness::halfWidth() const {
    const double widest = std::max(alphaU, alphaV);
    return ggx ? ggxHalfWidth(widest) : beckmannHalfWidth(widest);
}

void Roughness::applyTo(LobeDescription& lobe) const {
    lobe.device.alphaU = alphaU;
    lobe.device.alphaV = alphaV;
    const bool isOne = alphaTextureU == alphaTextureV;
    if (alphaTextureU) lobe.levelTextures.push_back({*alphaTextureU});
    if (alphaTextureV && !isOne) lobe.levelTextures.push_back({*alphaTextureV});
    lobe.axesByTexture = !isOne;
    lobe.setLevel = [u = alphaTextureU.has_value(), v = alphaTextureV.has_value()](shared::Lobe& device,
                                                                                   const std::vector<double>& alphas) {
        if (u) device.alphaU = static_cast<float>(alphas.front());
        if (v) device.alphaV = static_cast<float>(alphas.back());
    };
}

Roughness readRoughness(Properties& properties, const std::string& smooth, bool byTexture) {
    const auto isGiven = [&](const std::string& name) {
        return properties.has(name) || (byTexture && properties.texture(name));
    };
    const bool anisotropic = isGiven("alpha_u") || isGiven("alpha_v");
    if (anisotropic && (isGiven("alpha") || !isGiven("alpha_u") || !isGiven("alpha_v")))
        throw InputError(properties.where("alpha_u"), fmt::format("{}: give either alpha, or both alpha_u and alpha_v.",
                                                                  properties.element().get("type")));
    const auto read = [&](const std::string& name) { return readAlphaOrTexture(properties, name, smooth, byTexture); };
    const Scalar u = read(anisotropic ? "alpha_u" : "alpha");
    const Scalar v = anisotropic ? read("alpha_v") : u;
    Roughness roughness;
    roughness.ggx = properties.choiceOfAnyCase("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx";
    roughness.alphaU = static_cast<float>(u.value);
    roughness.alphaV = static_cast<float>(v.value);
    roughness.alphaTextureU = u.texture;
    roughness.alphaTextureV = v.texture;
    properties.accept({"sample_visible"});
    return roughness;
}

} // namespace quasilux
