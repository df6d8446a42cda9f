// <bsdf type="mask">: opacity of the nested bsdf; the rest of the light passes.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

BsdfLobes readMask(Properties& properties) {
    const Scalar opacity = readShare(properties, "opacity", 0.5f);
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.size() != 1)
        throw InputError(properties.element().where,
                         fmt::format("mask has {} nested bsdfs; it needs one.", nested.size()));
    BsdfLobes nothing;
    nothing.isNull = true;
    return blend(nothing, readBsdfLobes(*nested[0], properties.context()), opacity, properties.element().where);
}

} // namespace quasilux
