// <bsdf type="principledthin">: Disney's material for thin sheets, such as leaves and paper: the same on both sides (Burley 2015).
#include "scene/bsdfs/principled_parts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

/// Of the diffuse light the share that is transmitted; the parameter goes up to 2.
double readTransmittedShare(Properties& properties) {
    const double value = properties.numberAbove("diff_trans", 0, 0, false);
    if (value > 2)
        throw InputError(
            properties.where("diff_trans"),
            fmt::format("parameter 'diff_trans' is {}; expected 0 (all of the diffuse light is reflected) to "
                        "2 (all of it is transmitted).",
                        value));
    return value / 2;
}

/// A lobe that transmits the base colour times a share.
LobeDescription transmitting(const Principled& p, LobeDescription lobe, double share) {
    lobe.device.transmittance = p.base.scale * static_cast<float>(share);
    lobe.device.transmittanceTexture = p.base.texture;
    return lobe;
}

void addSpecular(const Principled& p, std::vector<LobeDescription>& lobes) {
    if (p.eta > 1 && p.specTint < 1) {
        LobeDescription lobe = facets(p, LOBE_GGX, grey(p.specTrans * (1 - p.specTint)));
        lobe.device.eta = grey(p.eta);
        lobe.device.k = {0, 0, 0};
        lobes.push_back(lobe);
    }
    const double tinted = p.specTrans * p.specTint, r = (p.eta - 1) / (p.eta + 1);
    if (tinted > 0) lobes.push_back(schlick(p, grey(1), p.tint() * static_cast<float>(tinted * r * r), grey(tinted)));
    // Both faces bend: what passes is spread less than what is reflected (there, fig. 15).
    Principled passed = p;
    passed.roughness = (0.65 * p.eta - 0.35) * p.roughness;
    LobeDescription lobe = transmitting(p, facets(passed, LOBE_THINGGX, grey(0)), p.specTrans);
    lobe.device.eta = grey(p.eta);
    lobes.push_back(lobe);
}

} // namespace

BsdfLobes readPrincipledThin(Properties& properties) {
    Principled p = readSharedParameters(properties);
    p.roughness = properties.share("roughness", 0.5);
    p.eta = readPrincipledIndex(properties);
    const double transmitted = readTransmittedShare(properties);
    properties.accept({"diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
                       "specular_transmittance_sampling_rate", "diffuse_transmittance_sampling_rate"});
    checkOneColor(p,
                  p.specTrans > 0 && p.specTint > 0 ? "spec_tint"
                  : p.sheen > 0 && p.sheenTint > 0  ? "sheen_tint"
                                                    : nullptr,
                  properties);
    const double diffuse = 1 - p.specTrans, reflected = diffuse * (1 - transmitted);
    BsdfLobes lobes;
    if (reflected > 0) addDiffuse(p, reflected, reflected, lobes.front);
    if (diffuse * transmitted > 0)
        lobes.front.push_back(transmitting(p, makeLobe(LOBE_DIFFUSETRANSMISSION, "diffuse", grey(0), lambertHalfWidth),
                                           diffuse * transmitted));
    if (p.specTrans > 0) addSpecular(p, lobes.front);
    lobes.back = lobes.front;
    return lobes;
}

} // namespace quasilux
