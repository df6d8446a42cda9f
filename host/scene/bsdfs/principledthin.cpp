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

/// A lobe that transmits the base colour times a share.
LobeDescription transmitting(const Principled& p, LobeDescription lobe, const Share& by) {
    lobe.device.transmittance = p.base.scale * static_cast<float>(by.constant);
    lobe.device.transmittanceTexture = p.base.texture;
    return weighted(std::move(lobe), by);
}

void addSpecular(const Principled& p, std::vector<LobeDescription>& lobes) {
    const Share specular = share(p.specTrans), untinted = specular * rest(p.specTint);
    if (p.eta != 1 && !untinted.isZero()) {
        LobeDescription lobe = facets(p, LOBE_GGX, grey(untinted.constant));
        lobe.device.eta = grey(p.eta);
        lobe.device.k = {0, 0, 0};
        lobes.push_back(weighted(lobe, untinted));
    }
    addSchlick(p, Share{0, {}}, specular * share(p.specTint), lobes);
    // Both faces bend: what passes is spread less than what is reflected (there, fig. 15).
    Principled passed = p;
    passed.narrowing = 0.65 * p.eta - 0.35;
    LobeDescription lobe = transmitting(p, facets(passed, LOBE_THINGGX, grey(0)), specular);
    lobe.device.eta = grey(p.eta);
    lobes.push_back(lobe);
}

} // namespace

BsdfLobes readPrincipledThin(Properties& properties) {
    Principled p = readSharedParameters(properties);
    p.eta = readPrincipledIndex(properties);
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
