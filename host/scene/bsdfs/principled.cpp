// <bsdf type="principled">: Disney's material, a sum of lobes (Burley 2012, 2015).
#include "scene/bsdfs/principled_parts.h"

#include <cmath>

namespace quasilux {

namespace {

/// `eta`, or `specular`, which stands for reflectances up to 8 % at normal incidence.
double readEta(Properties& properties) {
    if (properties.has("eta") && properties.has("specular"))
        throw InputError(properties.where("specular"), "principled has both eta and specular; keep one.");
    if (!properties.has("eta")) return 2 / (1 - std::sqrt(0.08 * properties.share("specular", 0.5))) - 1;
    return readPrincipledIndex(properties);
}

Principled readParameters(Properties& properties) {
    Principled p = readSharedParameters(properties);
    readPrincipledRoughness(properties, p);
    p.metallic = properties.share("metallic", 0);
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
    checkOneColor(p, coloured, properties);
    if (p.specTrans > 0 && p.eta == 1)
        throw InputError(
            properties.where("spec_trans"),
            "principled: light that is transmitted needs an index eta (or specular) that bends it; eta is 1.");
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
    addDiffuse(p, p.dielectric() * (1 - p.specTrans), p.dielectric(), lobes.front);
    addDielectric(p, lobes);
    addSchlick(p, lobes);
    addClearcoat(p, lobes);
    return lobes;
}

} // namespace quasilux
