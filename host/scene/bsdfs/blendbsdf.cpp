// <bsdf type="blendbsdf">: (1 - weight) of the first nested bsdf plus weight of the second.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

void addScaled(const std::vector<LobeDescription>& from, float factor, std::vector<LobeDescription>& to) {
    for (LobeDescription lobe : from) {
        lobe.device.reflectance = lobe.device.reflectance * factor;
        lobe.device.transmittance = lobe.device.transmittance * factor;
        to.push_back(lobe);
    }
}

} // namespace

BsdfLobes readBlend(Properties& properties) {
    const double weight = properties.number("weight", 0.5);
    if (weight < 0 || weight > 1)
        throw InputError(properties.where("weight"),
                         fmt::format("parameter 'weight' is {}; it must lie within [0, 1].", weight));
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.size() != 2)
        throw InputError(properties.element().where,
                         fmt::format("blendbsdf has {} nested bsdfs; it needs two.", nested.size()));
    BsdfLobes lobes;
    for (size_t i = 0; i < 2; ++i) {
        const BsdfLobes part = readBsdfLobes(*nested[i], properties.context());
        if (part.isNull)
            throw InputError(nested[i]->where,
                             "blendbsdf with a null bsdf (partial transparency) is not supported; blend two "
                             "bsdfs that scatter.");
        const float factor = static_cast<float>(i == 0 ? 1 - weight : weight);
        addScaled(part.front, factor, lobes.front);
        addScaled(part.back, factor, lobes.back);
    }
    constexpr size_t maximumLobes = 32; // a blend of blends doubles them at each level
    if (lobes.front.size() > maximumLobes || lobes.back.size() > maximumLobes)
        throw InputError(
            properties.element().where,
            fmt::format("blendbsdf comes to more than {} lobes on one side; blend fewer bsdfs.", maximumLobes));
    return lobes;
}

} // namespace quasilux
