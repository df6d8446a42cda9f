#include "scene/bsdfs/principled_parts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double leastAlpha = 0.001;

Rgb mix(Rgb a, Rgb b, double share) {
    const auto t = static_cast<float>(share);
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

} // namespace

double Principled::aspect() const { return std::sqrt(1 - 0.9 * anisotropic); }
double Principled::alphaU() const { return std::max(leastAlpha, roughness * roughness / aspect()); }
double Principled::alphaV() const { return std::max(leastAlpha, roughness * roughness * aspect()); }

Rgb Principled::tint() const {
    const auto brightness = static_cast<float>(luminance(base.scale));
    return brightness > 0 ? base.scale * (1 / brightness) : Rgb{1, 1, 1};
}

Principled readSharedParameters(Properties& properties) {
    Principled p;
    p.base = readReflectance(properties, "base_color", 0.5f);
    p.anisotropic = properties.share("anisotropic", 0);
    p.specTrans = properties.share("spec_trans", 0);
    p.specTint = properties.share("spec_tint", 0);
    p.sheen = properties.share("sheen", 0);
    p.sheenTint = properties.share("sheen_tint", 0);
    p.flatness = properties.share("flatness", 0);
    return p;
}

void readPrincipledRoughness(Properties& properties, Principled& p) {
    LoadContext& context = properties.context();
    const Scalar roughness = readShare(properties, "roughness", 0.5f);
    p.roughness = roughness.value;
    if (!roughness.texture) return;
    const TextureDescription& texture = context.scene.textures[*roughness.texture];
    if (!texture.attribute.empty() || texture.volume || texture.device.texture0 > 0 || texture.device.texture1 > 0)
        throw InputError(texture.where, "a roughness of principled that varies must be a 'bitmap' or a 'checkerboard' "
                                        "of two numbers; bake it into an image.");
    p.roughness = meanNumber(texture, 0.5f, context.scene);
    const auto squared = [&](double factor) {
        return squaredTexture(*roughness.texture, static_cast<float>(factor), static_cast<float>(leastAlpha), context);
    };
    p.alphaTextureU = squared(1 / p.aspect());
    p.alphaTextureV = squared(p.aspect());
}

double readPrincipledIndex(Properties& properties) {
    const double eta = properties.number("eta", 1.5);
    if (eta < 1)
        throw InputError(properties.where("eta"), fmt::format("parameter 'eta' is {}; it must be at least 1.", eta));
    return eta;
}

void checkOneColor(const Principled& p, const char* coloured, Properties& properties) {
    if (p.textured() && coloured)
        throw InputError(properties.where(coloured),
                         fmt::format("{}: {} needs one colour, and base_color is a texture; give it as <rgb>, "
                                     "or leave {} out.",
                                     properties.plugin(), coloured, coloured));
}

Rgb grey(double value) {
    const auto single = static_cast<float>(value);
    return {single, single, single};
}

Rgb sum(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }

LobeDescription facets(const Principled& p, unsigned type, const Reflectance& reflectance) {
    LobeDescription lobe = makeLobe(type, "specular", reflectance, ggxHalfWidth(std::max(p.alphaU(), p.alphaV())));
    lobe.device.alphaU = static_cast<float>(p.alphaU());
    lobe.device.alphaV = static_cast<float>(p.alphaV());
    lobe.alphaTextureU = p.alphaTextureU;
    lobe.alphaTextureV = p.alphaTextureV;
    return lobe;
}

LobeDescription schlick(const Principled& p, const Reflectance& scale, Rgb normal, Rgb grazing) {
    LobeDescription lobe = facets(p, LOBE_GGXSCHLICK, scale);
    lobe.device.eta = normal;
    lobe.device.k = grazing;
    return lobe;
}

void addDiffuse(const Principled& p, double diffuseShare, double sheenShare, std::vector<LobeDescription>& lobes) {
    Reflectance base = p.base;
    base.scale = base.scale * static_cast<float>(diffuseShare);
    LobeDescription lobe = makeLobe(LOBE_PRINCIPLEDDIFFUSE, "diffuse", base, lambertHalfWidth);
    lobe.device.alphaU = static_cast<float>(p.roughness);
    lobe.device.exponent = static_cast<float>(p.flatness);
    lobes.push_back(lobe);
    if (p.sheen == 0) return;
    const Rgb color = mix(grey(1), p.textured() ? grey(1) : p.tint(), p.sheenTint);
    lobes.push_back(makeLobe(LOBE_SHEEN, "sheen", color * static_cast<float>(p.sheen * sheenShare), lambertHalfWidth));
}

} // namespace quasilux
