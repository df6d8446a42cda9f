// <bsdf type="twosided">: a one-sided bsdf on both sides, or one for each.
#include "scene/bsdfs/bsdf_plugin.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

bool letsLightThrough(const LobeDescription& lobe) {
    const unsigned type = lobe.device.type;
    return type == LOBE_DIELECTRIC || type == LOBE_THINDIELECTRIC || LOBE_TRANSMITS(type) || LOBE_PASSES(type);
}

/// Of one that has two sides already the front counts, as in Mitsuba.
BsdfLobes readSide(const Element& nested, LoadContext& context) {
    BsdfLobes lobes = readBsdfLobes(nested, context);
    if (lobes.isNull || std::any_of(lobes.front.begin(), lobes.front.end(), letsLightThrough))
        throw InputError(nested.where,
                         fmt::format("twosided: the nested bsdf '{}' lets light through; use it without twosided.",
                                     nested.get("type")));
    return lobes;
}

} // namespace

BsdfLobes readTwoSided(Properties& properties) {
    properties.accept({"allow_transmission"}); // bsdfs that transmit are refused; others need no leave
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.empty() || nested.size() > 2)
        throw InputError(
            properties.element().where,
            fmt::format("twosided has {} nested bsdfs; it needs one, or two (front, back).", nested.size()));
    BsdfLobes lobes = readSide(*nested[0], properties.context());
    lobes.backRelief = lobes.frontRelief;
    lobes.back = lobes.front;
    if (nested.size() == 2) {
        const BsdfLobes back = readSide(*nested[1], properties.context());
        lobes.back = back.front;
        lobes.backRelief = back.frontRelief;
    }
    if (lobes.backRelief) lobes.backRelief->flags |= RELIEF_MIRRORED;
    return lobes;
}

} // namespace quasilux
