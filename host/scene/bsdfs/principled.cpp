// <bsdf type="principled">: Disney's material, a sum of lobes (Burley 2012, 2015).
#include "scene/bsdfs/bsdf_plugin.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

struct Principled {
    Reflectance base{Rgb{0.5f, 0.5f, 0.5f}};
    double roughness, anisotropic, metallic, specTrans, specTint, sheen, sheenTint, flatness, clearcoat, clearcoatGloss;
    double eta;

    double dielectric() const { return 1 - metallic; }
    bool textured() const { return base.texture != 0; }
    double alphaU() const { return std::max(0.001, roughness * roughness / aspect()); }
    double alphaV() const { return std::max(0.001, roughness * roughness * aspect()); }
    double aspect() const { return std::sqrt(1 - 0.9 * anisotropic); }
    /// The base colour at luminance 1; white where it is black.
    Rgb tint() const {
        const auto brightness = static_cast<float>(luminance(base.scale));
        return brightness > 0 ? base.scale * (1 / brightness) : Rgb{1, 1, 1};
    }
};

Rgb grey(double value) {
    const auto single = static_cast<float>(value);
    return {single, single, single};
}

Rgb mix(Rgb a, Rgb b, double share) {
    const auto t = static_cast<float>(share);
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

Rgb sum(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }

/// `eta`, or `specular`, which stands for reflectances up to 8 % at normal incidence.
double readEta(Properties& properties) {
    if (properties.has("eta") && properties.has("specular"))
        throw InputError(properties.where("specular"), "principled has both eta and specular; keep one.");
    if (!properties.has("eta")) return 2 / (1 - std::sqrt(0.08 * properties.share("specular", 0.5))) - 1;
    const double eta = properties.number("eta", 1.5);
    if (eta < 1)
        throw InputError(properties.where("eta"), fmt::format("parameter 'eta' is {}; it must be at least 1.", eta));
    return eta;
}

Principled readParameters(Properties& properties) {
    Principled p;
    p.base = readReflectance(properties, "base_color", 0.5f);
    p.roughness = properties.share("roughness", 0.5);
    p.anisotropic = properties.share("anisotropic", 0);
    p.metallic = properties.share("metallic", 0);
    p.specTrans = properties.share("spec_trans", 0);
    p.specTint = properties.share("spec_tint", 0);
    p.sheen = properties.share("sheen", 0);
    p.sheenTint = properties.share("sheen_tint", 0);
    p.flatness = properties.share("flatness", 0);
    p.clearcoat = properties.share("clearcoat", 0);
    p.clearcoatGloss = properties.share("clearcoat_gloss", 0);
    p.eta = readEta(properties);
    properties.accept({"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate", "clearcoat_sampling_rate"});
    return p;
}

void check(const Principled& p, Properties& properties) {
    const char* coloured = p.specTrans > 0                  ? "spec_trans"
                           : p.specTint > 0                 ? "spec_tint"
                           : p.sheen > 0 && p.sheenTint > 0 ? "sheen_tint"
                                                            : nullptr;
    if (p.textured() && coloured)
        throw InputError(properties.where(coloured),
                         fmt::format("principled: {} needs one colour, and base_color is a texture; give it as <rgb>, "
                                     "or leave {} out.",
                                     coloured, coloured));
    if (p.specTrans > 0 && p.eta == 1)
        throw InputError(
            properties.where("spec_trans"),
            "principled: light that is transmitted needs an index eta (or specular) that bends it; eta is 1.");
}

LobeDescription facets(const Principled& p, unsigned type, const Reflectance& reflectance) {
    LobeDescription lobe = makeLobe(type, "specular", reflectance, ggxHalfWidth(std::max(p.alphaU(), p.alphaV())));
    lobe.device.alphaU = static_cast<float>(p.alphaU());
    lobe.device.alphaV = static_cast<float>(p.alphaV());
    return lobe;
}

/// From `normal` at normal incidence to `grazing`.
LobeDescription schlick(const Principled& p, const Reflectance& scale, Rgb normal, Rgb grazing) {
    LobeDescription lobe = facets(p, LOBE_GGXSCHLICK, scale);
    lobe.device.eta = normal;
    lobe.device.k = grazing;
    return lobe;
}

/// Fresnel's reflectance of the part that is neither metal nor tinted, and what passes.
void addDielectric(const Principled& p, BsdfLobes& lobes) {
    const Rgb reflected = grey(p.dielectric() * (1 - p.specTint));
    if (p.specTrans == 0) {
        LobeDescription lobe = facets(p, LOBE_GGX, reflected);
        lobe.device.eta = grey(p.eta);
        lobe.device.k = {0, 0, 0};
        if (p.eta > 1) lobes.front.push_back(lobe);
        return;
    }
    const double share = p.specTrans * p.dielectric();
    const Rgb base = p.base.scale;
    const Rgb root = {std::sqrt(base.r), std::sqrt(base.g), std::sqrt(base.b)};
    LobeDescription lobe = facets(p, LOBE_GGXDIELECTRIC, reflected);
    lobe.device.transmittance = root * static_cast<float>(share);
    lobe.device.eta = grey(p.eta);
    lobes.front.push_back(lobe);
    lobe.device.reflectance = grey(share);
    lobe.device.eta = grey(1 / p.eta);
    lobes.back.push_back(lobe);
}

/// Metal and tint, whose reflectances go by Schlick.
void addSchlick(const Principled& p, BsdfLobes& lobes) {
    if (p.textured()) {
        Reflectance metal = p.base;
        metal.scale = metal.scale * static_cast<float>(p.metallic);
        lobes.front.push_back(schlick(p, metal, grey(1), grey(0)));
        lobes.front.push_back(schlick(p, grey(p.metallic), grey(0), grey(1)));
        return;
    }
    const double tinted = p.dielectric() * p.specTint, r = (p.eta - 1) / (p.eta + 1);
    const Rgb normal =
        sum(p.base.scale * static_cast<float>(p.metallic), p.tint() * static_cast<float>(tinted * r * r));
    if (p.metallic + tinted > 0) lobes.front.push_back(schlick(p, grey(1), normal, grey(p.metallic + tinted)));
}

void addDiffuse(const Principled& p, BsdfLobes& lobes) {
    Reflectance base = p.base;
    base.scale = base.scale * static_cast<float>(p.dielectric() * (1 - p.specTrans));
    LobeDescription lobe = makeLobe(LOBE_PRINCIPLEDDIFFUSE, "diffuse", base, lambertHalfWidth);
    lobe.device.alphaU = static_cast<float>(p.roughness);
    lobe.device.exponent = static_cast<float>(p.flatness);
    lobes.front.push_back(lobe);
    if (p.sheen == 0) return;
    const Rgb color = mix(grey(1), p.textured() ? grey(1) : p.tint(), p.sheenTint);
    lobes.front.push_back(
        makeLobe(LOBE_SHEEN, "sheen", color * static_cast<float>(p.sheen * p.dielectric()), lambertHalfWidth));
}

void addClearcoat(const Principled& p, BsdfLobes& lobes) {
    const double alpha = 0.1 + (0.001 - 0.1) * p.clearcoatGloss;
    // Half of D cos lies within tan² = alpha.
    LobeDescription lobe = makeLobe(LOBE_CLEARCOAT, "clearcoat", grey(p.clearcoat), 2 * std::atan(std::sqrt(alpha)));
    lobe.device.alphaU = static_cast<float>(alpha);
    lobes.front.push_back(lobe);
}

} // namespace

BsdfLobes readPrincipled(Properties& properties) {
    const Principled p = readParameters(properties);
    check(p, properties);
    BsdfLobes lobes;
    addDiffuse(p, lobes);
    addDielectric(p, lobes);
    addSchlick(p, lobes);
    addClearcoat(p, lobes);
    return lobes;
}

} // namespace quasilux
