// <phase type="blendphase">: two phase functions, the second one with the share `weight`. Blends within blends become
// one list of weighted functions.
#include "scene/phases/phase_plugin.h"
#include "scene/textures/texture_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr size_t partsMax = 16;

void appendParts(std::vector<PhasePartDescription>& parts, const MediumDescription& phase, double weight) {
    if (!(weight > 0)) return;
    if (phase.phase != PHASE_MIXED) parts.push_back({phase.phase, phase.g, weight, {}});
    for (PhasePartDescription part : phase.phaseParts) {
        part.weight *= weight;
        parts.push_back(std::move(part));
    }
}

} // namespace

void readBlend(Properties& properties, MediumDescription& medium) {
    if (const Element* volume = properties.volume("weight"))
        throw InputError(volume->where,
                         fmt::format("parameter 'weight' of {} is the same everywhere here; give it as a "
                                     "<float>.",
                                     properties.describe()));
    if (!properties.has("weight"))
        throw InputError(properties.where("weight"),
                         fmt::format("{} needs <float name=\"weight\" value=\"…\"/>, the share of its second phase "
                                     "function.",
                                     properties.describe()));
    const double weight = clampedWeight(properties, "weight", properties.number("weight", 0.5));
    const std::vector<const Element*> nested = properties.objects("phase");
    if (nested.size() != 2)
        throw InputError(properties.element().where,
                         fmt::format("{} has {} phase functions; expected 2.", properties.describe(), nested.size()));
    MediumDescription first, second;
    readPhase(*nested[0], properties.context(), first);
    readPhase(*nested[1], properties.context(), second);
    medium.phase = PHASE_MIXED;
    medium.phaseParts.clear();
    appendParts(medium.phaseParts, first, 1 - weight);
    appendParts(medium.phaseParts, second, weight);
    if (medium.phaseParts.size() > partsMax)
        throw InputError(properties.element().where,
                         fmt::format("{} blends {} phase functions; expected at most {}.", properties.describe(),
                                     medium.phaseParts.size(), partsMax));
    medium.g = (1 - weight) * first.g + weight * second.g;
}

} // namespace quasilux
