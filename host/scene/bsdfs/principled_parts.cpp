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

/// `squaredAspect`: of the facets' ellipse.
double alphaAlong(double roughness, double squaredAspect, bool u) {
    const double aspect = std::sqrt(squaredAspect);
    return std::max(leastAlpha, u ? roughness * roughness / aspect : roughness * roughness * aspect);
}

double squaredAspect(const Principled& p) { return 1 - 0.9 * p.anisotropic.value; }

/// Where textures say roughness or anisotropy, the lobe's alphas go by them; those of what passes by the index too.
void setFacetLevels(const Principled& p, LobeDescription& lobe) {
    if (p.roughness.texture) lobe.levelTextures.push_back({*p.roughness.texture});
    if (p.anisotropic.texture) lobe.levelTextures.push_back({*p.anisotropic.texture, 1, -0.9});
    const bool byIndex = p.passed && p.eta.texture;
    if (byIndex) lobe.levelTextures.push_back({*p.eta.texture});
    if (lobe.levelTextures.empty()) return;
    lobe.axesByTexture = p.anisotropic.texture || (p.roughness.texture && p.anisotropic.value > 0);
    lobe.setLevel = [p, byIndex](shared::Lobe& device, const std::vector<double>& values) {
        auto next = values.begin();
        const double ownRoughness = p.roughness.texture ? *next++ : p.roughness.value;
        const double aspect = p.anisotropic.texture ? *next++ : squaredAspect(p);
        const double index = byIndex ? *next : p.eta.value;
        if (byIndex) device.eta = grey(index);
        const double roughness = p.narrowing(index) * ownRoughness;
        device.alphaU = static_cast<float>(alphaAlong(roughness, aspect, true));
        device.alphaV = static_cast<float>(alphaAlong(roughness, aspect, false));
    };
}

LobeDescription diffuseLobe(const Principled& p, const Share& by, double flatness) {
    Reflectance base = p.base;
    base.scale = base.scale * static_cast<float>(by.constant);
    LobeDescription lobe = makeLobe(LOBE_PRINCIPLEDDIFFUSE, "diffuse", base, lambertHalfWidth);
    lobe.device.alphaU = static_cast<float>(p.roughness.value);
    lobe.device.exponent = static_cast<float>(flatness);
    if (p.roughness.texture) {
        lobe.levelTextures = {{*p.roughness.texture}};
        lobe.setLevel = [](shared::Lobe& device, const std::vector<double>& values) {
            device.alphaU = static_cast<float>(values.front());
        };
    }
    return weighted(lobe, by);
}

void addSheen(const Principled& p, const Share& by, std::vector<LobeDescription>& lobes) {
    const auto add = [&](Rgb color, const Share& of) {
        lobes.push_back(
            weighted(makeLobe(LOBE_SHEEN, "sheen", color * static_cast<float>(of.constant), lambertHalfWidth), of));
    };
    const Share sheen = share(p.sheen) * by;
    if (!p.textured() && !p.sheenTint.texture) {
        add(mix(grey(1), p.tint(), p.sheenTint.value), sheen);
        return;
    }
    add(grey(1), sheen * rest(p.sheenTint));
    const Share tinted = sheen * share(p.sheenTint);
    p.textured() ? add(grey(1), tinted * ofBase(p, WEIGHT_TINT)) : add(p.tint(), tinted);
}

/// From `color` of a texture, times `normal`, to white. The two ends are weighed apart.
void addTexturedSchlick(const Principled& p, const Reflectance& color, double normal, const Share& by,
                        std::vector<LobeDescription>& lobes) {
    Reflectance scaled = color;
    scaled.scale = scaled.scale * static_cast<float>(by.constant * normal);
    lobes.push_back(weighted(schlick(p, scaled, grey(1), grey(0)), by));
}

} // namespace

double Principled::alphaU() const {
    return alphaAlong(narrowing(eta.value) * roughness.value, squaredAspect(*this), true);
}
double Principled::alphaV() const {
    return alphaAlong(narrowing(eta.value) * roughness.value, squaredAspect(*this), false);
}

Rgb Principled::tint() const {
    const auto brightness = static_cast<float>(luminance(base.scale));
    return brightness > 0 ? base.scale * (1 / brightness) : Rgb{1, 1, 1};
}

double Principled::normalReflectance() const {
    const double r = (eta.value - 1) / (eta.value + 1);
    return r * r;
}

Share Share::operator*(const Share& other) const {
    Share product{constant * other.constant, weights};
    product.weights.insert(product.weights.end(), other.weights.begin(), other.weights.end());
    return product;
}

Share share(const Scalar& parameter) {
    if (!parameter.texture) return {parameter.value, {}};
    return {1, {weightBy(*parameter.texture)}};
}

Share rest(const Scalar& parameter, double factor) {
    if (!parameter.texture) return {1 - factor * parameter.value, {}};
    return {1, {weightBy(*parameter.texture, 1, -factor)}};
}

Share ofBase(const Principled& p, unsigned function) {
    Share share{1, {weightBy(p.base.texture - 1)}};
    share.weights.front().function = function;
    return share;
}

Share ofIndex(const Principled& p, unsigned function) {
    Share share{1, {weightBy(*p.eta.texture)}};
    share.weights.front().function = function;
    return share;
}

LobeDescription weighted(LobeDescription lobe, const Share& by, unsigned parts) {
    for (shared::LobeWeight weight : by.weights) {
        weight.parts = parts;
        lobe.weights.push_back(weight);
    }
    return lobe;
}

Principled readSharedParameters(Properties& properties) {
    Principled p;
    p.base = readReflectance(properties, "base_color", 0.5f);
    p.roughness = readShare(properties, "roughness", 0.5f);
    p.anisotropic = readShare(properties, "anisotropic", 0);
    p.specTrans = readShare(properties, "spec_trans", 0);
    p.specTint = readShare(properties, "spec_tint", 0);
    p.sheen = readShare(properties, "sheen", 0);
    p.sheenTint = readShare(properties, "sheen_tint", 0);
    p.flatness = readShare(properties, "flatness", 0);
    return p;
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
    setFacetLevels(p, lobe);
    return lobe;
}

LobeDescription schlick(const Principled& p, const Reflectance& scale, Rgb normal, Rgb grazing) {
    LobeDescription lobe = facets(p, LOBE_GGXSCHLICK, scale);
    lobe.device.eta = normal;
    lobe.device.k = grazing;
    return lobe;
}

void addSchlick(const Principled& p, const Share& metal, const Share& tinted, std::vector<LobeDescription>& lobes) {
    const double tintedNormal = p.normalReflectance();
    const bool areConstant = metal.weights.empty() && tinted.weights.empty();
    const auto addGrazing = [&](const Share& by) {
        lobes.push_back(weighted(schlick(p, grey(by.constant), grey(0), grey(1)), by));
    };
    if (p.textured()) {
        addTexturedSchlick(p, p.base, 1, metal, lobes);
        addTexturedSchlick(p, grey(1), tintedNormal, tinted * ofBase(p, WEIGHT_TINT), lobes);
        if (areConstant) return addGrazing({metal.constant + tinted.constant, {}});
        addGrazing(metal);
        addGrazing(tinted);
        return;
    }
    const auto add = [&](Rgb normal, const Share& by) {
        lobes.push_back(weighted(schlick(p, grey(1), normal, grey(by.constant)), by));
    };
    const Rgb ofMetal = p.base.scale * static_cast<float>(metal.constant);
    const Rgb ofTint = p.tint() * static_cast<float>(tinted.constant * tintedNormal);
    if (areConstant) {
        if (metal.constant + tinted.constant > 0) add(sum(ofMetal, ofTint), {metal.constant + tinted.constant, {}});
        return;
    }
    if (!metal.isZero()) add(ofMetal, metal);
    if (!tinted.isZero()) add(ofTint, tinted);
}

void addDiffuse(const Principled& p, const Share& diffuse, const Share& sheen, std::vector<LobeDescription>& lobes) {
    if (p.flatness.texture) {
        lobes.push_back(diffuseLobe(p, diffuse * rest(p.flatness), 0));
        lobes.push_back(diffuseLobe(p, diffuse * share(p.flatness), 1));
    } else
        lobes.push_back(diffuseLobe(p, diffuse, p.flatness.value));
    if (!p.sheen.isZero()) addSheen(p, sheen, lobes);
}

} // namespace quasilux
