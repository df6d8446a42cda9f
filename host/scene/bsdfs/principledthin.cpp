// <bsdf type="principledthin">: Disney's material for thin sheets, such as leaves and paper: the same on both sides
// (Burley 2015).
#include "scene/bsdfs/principled_parts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

/// Twice the share of the diffuse light that is transmitted: a texture, or a number up to 2.
Scalar readTwiceTransmitted(Properties& properties) {
    if (properties.texture("diff_trans")) return readShare(properties, "diff_trans", 0);
    const double value = properties.numberAbove("diff_trans", 0, 0, false);
    if (value > 2)
        throw InputError(
            properties.where("diff_trans"),
            fmt::format("parameter 'diff_trans' is {}; expected 0 (all of the diffuse light is reflected) to "
                        "2 (all of it is transmitted).",
                        value));
    return {value, std::nullopt};
}

/// An index above 0, of a colour the mean, or a texture of such.
Scalar readSheetIndex(Properties& properties) {
    if (properties.texture("eta")) return readNumbers(properties, "eta", 1.5f, TextureUse::index);
    const double value = properties.textureNumber("eta", 1.5);
    if (value > 0) return {value, std::nullopt};
    throw InputError(properties.where("eta"), fmt::format("parameter 'eta' of {} is {}; it must be greater than 0.",
                                                          properties.describe(), value));
}

/// A lobe that transmits the base colour times a share.
LobeDescription transmitting(const Principled& p, LobeDescription lobe, const Share& by) {
    lobe.device.transmittance = p.base.scale * static_cast<float>(by.constant);
    lobe.device.transmittanceTexture = p.base.texture;
    return weighted(std::move(lobe), by);
}

/// Reflection that has the tint of the base colour. Where a texture says the index, the part that goes by the
/// reflectance at normal incidence is weighed apart from the part at grazing incidence.
void addTinted(const Principled& p, const Share& tinted, std::vector<LobeDescription>& lobes) {
    if (!p.eta.texture) return addSchlick(p, Share{0, {}}, tinted, lobes);
    if (tinted.isZero()) return;
    Share normal = tinted * ofIndex(p, WEIGHT_NORMALREFLECTANCE);
    if (p.textured()) normal = normal * ofBase(p, WEIGHT_TINT);
    const Rgb tint = p.textured() ? grey(1) : p.tint();
    lobes.push_back(weighted(schlick(p, tint * static_cast<float>(tinted.constant), grey(1), grey(0)), normal));
    lobes.push_back(weighted(schlick(p, grey(tinted.constant), grey(0), grey(1)), tinted));
}

void addSpecular(const Principled& p, std::vector<LobeDescription>& lobes) {
    const Share specular = share(p.specTrans), untinted = specular * rest(p.specTint);
    if ((p.eta.texture || p.eta.value != 1) && !untinted.isZero()) {
        LobeDescription lobe = facets(p, LOBE_GGX, grey(untinted.constant));
        lobe.device.eta = grey(p.eta.value);
        lobe.device.etaTexture = p.eta.texture ? *p.eta.texture + 1 : 0;
        lobe.device.k = {0, 0, 0};
        lobes.push_back(weighted(lobe, untinted));
    }
    addTinted(p, specular * share(p.specTint), lobes);
    // Both faces bend: what passes is spread less than what is reflected (there, fig. 15).
    Principled passed = p;
    passed.passed = true;
    LobeDescription lobe = transmitting(p, facets(passed, LOBE_THINGGX, grey(0)), specular);
    lobe.device.eta = grey(p.eta.value);
    lobes.push_back(lobe);
}

} // namespace

BsdfLobes readPrincipledThin(Properties& properties) {
    Principled p = readSharedParameters(properties);
    p.eta = readSheetIndex(properties);
    const Scalar twice = readTwiceTransmitted(properties);
    properties.accept({"diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
                       "specular_transmittance_sampling_rate", "diffuse_transmittance_sampling_rate"});
    const Share diffuse = rest(p.specTrans), reflected = diffuse * rest(twice, 0.5),
                transmitted = diffuse * share(twice) * 0.5;
    BsdfLobes lobes;
    if (!reflected.isZero()) addDiffuse(p, reflected, reflected, lobes.front);
    if (!transmitted.isZero())
        lobes.front.push_back(
            transmitting(p, makeLobe(LOBE_DIFFUSETRANSMISSION, "diffuse", grey(0), lambertHalfWidth), transmitted));
    if (!p.specTrans.isZero()) addSpecular(p, lobes.front);
    lobes.back = lobes.front;
    return lobes;
}

} // namespace quasilux
