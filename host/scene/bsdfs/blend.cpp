// Sums of bsdfs, weighted by a number or a texture, and what is a sum with the surface that is not there.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr size_t maximumLobes = 32; // a blend of blends doubles them at each level

/// As part of a sum a surface that is not there lets light pass.
void turnIntoLobes(BsdfLobes& bsdf) {
    if (!bsdf.isNull) return;
    bsdf.front = bsdf.back = {passageLobe()};
    bsdf.isNull = false;
}

/// Appends `lobes` to `to`, times the weight or, where `isRest`, 1 less the weight.
void appendShare(const std::vector<LobeDescription>& lobes, const Scalar& weight, bool isRest,
                 std::vector<LobeDescription>& to) {
    const auto value = static_cast<float>(weight.value);
    const float factor = weight.texture ? 1.0f : (isRest ? 1 - value : value);
    for (LobeDescription lobe : lobes) {
        lobe.device.reflectance = lobe.device.reflectance * factor;
        lobe.device.transmittance = lobe.device.transmittance * factor;
        if (weight.texture)
            lobe.weights.push_back(isRest ? weightBy(*weight.texture, 1, -1) : weightBy(*weight.texture));
        to.push_back(std::move(lobe));
    }
}

bool same(const shared::Relief& a, const shared::Relief& b) {
    return a.type == b.type && a.texture == b.texture && a.scale == b.scale && a.flags == b.flags;
}

/// Of one side of the sum: a part without lobes has no say.
std::optional<shared::Relief> commonRelief(bool firstScatters, const std::optional<shared::Relief>& first,
                                           bool secondScatters, const std::optional<shared::Relief>& second,
                                           const SourceLocation& where) {
    if (!firstScatters) return second;
    if (!secondScatters) return first;
    if (first.has_value() != second.has_value() || (first && !same(*first, *second)))
        throw InputError(where,
                         "the blended bsdfs have different normals; put the blend into one normalmap or bumpmap.");
    return first;
}

} // namespace

BsdfLobes blend(BsdfLobes first, BsdfLobes second, const Scalar& weightOfSecond, const SourceLocation& where) {
    if (first.isNull && second.isNull) return first;
    BsdfLobes sum;
    const auto scatters = [](const BsdfLobes& part, const auto& side) { return !part.isNull && !side.empty(); };
    sum.frontRelief = commonRelief(scatters(first, first.front), first.frontRelief, scatters(second, second.front),
                                   second.frontRelief, where);
    sum.backRelief = commonRelief(scatters(first, first.back), first.backRelief, scatters(second, second.back),
                                  second.backRelief, where);
    turnIntoLobes(first);
    turnIntoLobes(second);
    appendShare(first.front, weightOfSecond, true, sum.front);
    appendShare(first.back, weightOfSecond, true, sum.back);
    appendShare(second.front, weightOfSecond, false, sum.front);
    appendShare(second.back, weightOfSecond, false, sum.back);
    if (sum.front.size() > maximumLobes || sum.back.size() > maximumLobes)
        throw InputError(
            where, fmt::format("this blend comes to more than {} lobes on one side; blend fewer bsdfs.", maximumLobes));
    return sum;
}

/// <bsdf type="blendbsdf">: (1 - weight) of the first nested bsdf plus weight of the second.
BsdfLobes readBlend(Properties& properties) {
    const Scalar weight = readWeight(properties, "weight", 0.5f);
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.size() != 2)
        throw InputError(properties.element().where,
                         fmt::format("blendbsdf has {} nested bsdfs; it needs two.", nested.size()));
    return blend(readBsdfLobes(*nested[0], properties.context()), readBsdfLobes(*nested[1], properties.context()),
                 weight, properties.element().where);
}

/// <bsdf type="mask">: opacity of the nested bsdf; the rest of the light passes.
BsdfLobes readMask(Properties& properties) {
    const Scalar opacity = readWeight(properties, "opacity", 0.5f);
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.size() != 1)
        throw InputError(properties.element().where,
                         fmt::format("mask has {} nested bsdfs; it needs one.", nested.size()));
    BsdfLobes nothing;
    nothing.isNull = true;
    return blend(nothing, readBsdfLobes(*nested[0], properties.context()), opacity, properties.element().where);
}

/// <bsdf type="null">: a surface that light passes through as if it were not there.
BsdfLobes readNull(Properties&) {
    BsdfLobes lobes;
    lobes.isNull = true;
    return lobes;
}

} // namespace quasilux
