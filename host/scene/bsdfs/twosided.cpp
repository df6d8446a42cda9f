// <bsdf type="twosided">: a one-sided bsdf on both sides, or one for each.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

BsdfLobes readSide(const Element& nested, LoadContext& context) {
    BsdfLobes lobes = readBsdfLobes(nested, context);
    if (lobes.isNull || !lobes.back.empty())
        throw InputError(nested.where,
                         fmt::format("twosided: the nested bsdf '{}' lets light through or has two sides already; "
                                     "use it without twosided.",
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
