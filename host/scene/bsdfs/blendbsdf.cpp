// <bsdf type="blendbsdf">: (1 - weight) of the first nested bsdf plus weight of the second.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

BsdfLobes readBlend(Properties& properties) {
    const Scalar weight = readShare(properties, "weight", 0.5f);
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.size() != 2)
        throw InputError(properties.element().where,
                         fmt::format("blendbsdf has {} nested bsdfs; it needs two.", nested.size()));
    return blend(readBsdfLobes(*nested[0], properties.context()), readBsdfLobes(*nested[1], properties.context()),
                 weight, properties.element().where);
}

} // namespace quasilux
