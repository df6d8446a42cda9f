// <bsdf type="principled">: Disney's material, a sum of lobes (Burley 2012, 2015).
#include "scene/bsdfs/principled_parts.h"

#include <cmath>

namespace quasilux {

namespace {

/// `eta`, or `specular`, which stands for reflectances up to 8 % at normal incidence. An index of 1 bends no light
/// that is transmitted: as in Mitsuba it is a little more then.
double readEta(Properties& properties, bool transmits) {
    if (properties.has("eta") && properties.has("specular"))
        throw InputError(properties.where("specular"), "principled has both eta and specular; keep one.");
    if (properties.has("eta")) {
        const double eta = properties.numberAbove("eta", 1.5, 0, true);
        return transmits && eta == 1 ? 1.001 : eta;
    }
    const double specular = properties.share("specular", 0.5);
    return 2 / (1 - std::sqrt(0.08 * (transmits && specular == 0 ? 0.001 : specular))) - 1;
}

Principled readParameters(Properties& properties) {
    Principled p = readSharedParameters(properties);
    p.metallic = readShare(properties, "metallic", 0);
    p.clearcoat = readShare(properties, "clearcoat", 0);
    p.clearcoatGloss = readShare(properties, "clearcoat_gloss", 0);
    p.eta.value = readEta(properties, !p.specTrans.isZero());
    properties.accept({"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate", "clearcoat_sampling_rate"});
    return p;
}

/// The root of the base colour, which light that passes has, and what a texture gives of it.
Rgb passedColor(const Principled& p) {
    const Rgb base = p.base.scale;
    return {std::sqrt(base.r), std::sqrt(base.g), std::sqrt(base.b)};
}

/// Fresnel's reflectance of the part that is neither metal nor tinted, and what passes.
void addDielectric(const Principled& p, BsdfLobes& lobes) {
    const Share dielectric = rest(p.metallic), untinted = rest(p.specTint);
    const Rgb reflected = grey(dielectric.constant * untinted.constant);
    if (p.specTrans.isZero()) {
        LobeDescription lobe = weighted(facets(p, LOBE_GGX, reflected), dielectric * untinted);
        lobe.device.eta = grey(p.eta.value);
        lobe.device.k = {0, 0, 0};
        if (p.eta.value != 1) lobes.front.push_back(lobe);
        return;
    }
    const Share passing = share(p.specTrans) * dielectric;
    const Share colored = p.textured() ? ofBase(p, WEIGHT_ROOT) : Share{};
    LobeDescription lobe = facets(p, LOBE_GGXDIELECTRIC, reflected);
    lobe.device.transmittance = passedColor(p) * static_cast<float>(passing.constant);
    lobe.device.eta = grey(p.eta.value);
    LobeDescription front = weighted(lobe, dielectric * untinted, WEIGHS_REFLECTED);
    lobes.front.push_back(weighted(front, passing * colored, WEIGHS_TRANSMITTED));
    lobe.device.reflectance = grey(passing.constant);
    lobe.device.eta = grey(1 / p.eta.value);
    lobes.back.push_back(weighted(weighted(lobe, passing), colored, WEIGHS_TRANSMITTED));
}

double clearcoatAlpha(double gloss) { return 0.1 + (0.001 - 0.1) * gloss; }

void addClearcoat(const Principled& p, BsdfLobes& lobes) {
    if (p.clearcoat.isZero()) return;
    const double alpha = clearcoatAlpha(p.clearcoatGloss.value);
    const Share by = share(p.clearcoat);
    // Half of D cos lies within tan² = alpha.
    LobeDescription lobe = makeLobe(LOBE_CLEARCOAT, "clearcoat", grey(by.constant), 2 * std::atan(std::sqrt(alpha)));
    lobe.device.alphaU = static_cast<float>(alpha);
    if (p.clearcoatGloss.texture) {
        lobe.levelTextures = {{*p.clearcoatGloss.texture, clearcoatAlpha(0), clearcoatAlpha(1) - clearcoatAlpha(0)}};
        lobe.setLevel = [](shared::Lobe& device, const std::vector<double>& values) {
            device.alphaU = static_cast<float>(values.front());
        };
    }
    lobes.front.push_back(weighted(lobe, by));
}

} // namespace

BsdfLobes readPrincipled(Properties& properties) {
    const Principled p = readParameters(properties);
    const Share dielectric = rest(p.metallic);
    BsdfLobes lobes;
    addDiffuse(p, dielectric * rest(p.specTrans), dielectric, lobes.front);
    addDielectric(p, lobes);
    // Without a reflectance at normal incidence Mitsuba leaves out metal and tint, too.
    if (p.eta.value != 1) addSchlick(p, share(p.metallic), dielectric * share(p.specTint), lobes.front);
    addClearcoat(p, lobes);
    return lobes;
}

} // namespace quasilux
