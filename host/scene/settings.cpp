// `<?quasilux …?>` directly in the scene.
#include "scene/settings.h"

#include "scene/quasi_specular.h"
#include "scene/xml/names.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace quasilux {

namespace {

const Names settingNames = {"bdd",     "variant",      "quasi-specular",  "direct", "caustics", "map",
                            "photons", "camera-paths", "camera-sampling", "seed",   "units",    "instances"};

template <NamedChoice Choice>
Choice choiceOf(const Attribute& entry, const SourceLocation& where) {
    if (const auto found = findChoice<Choice>(entry.value)) return *found;
    const auto& names = choiceWords<Choice>.names;
    throw InputError(where, fmt::format("{}: unknown value '{}'.{}", entry.name, entry.value,
                                        knownNames(entry.value, Names(names.begin(), names.end()))));
}

std::string parseQuasiSpecular(const Attribute& entry, const SourceLocation& where) {
    if (isPhaseLevel(entry.value))
        parsePhaseLevel(entry.value, where);
    else if (entry.value == "yes" || entry.value == "no" || splitList(entry.value).empty())
        throw InputError(where, fmt::format("quasi-specular=\"{}\" of a scene: expected auto, none, all, level:NUMBER, "
                                            "or ids of bsdfs and media.",
                                            entry.value));
    return entry.value;
}

void apply(const Attribute& entry, const SourceLocation& where, SceneSettings& settings) {
    if (entry.name == "bdd")
        settings.bdd = static_cast<unsigned>(parseUnsigned(entry.value, 0, bddLimit, where, "bdd"));
    else if (entry.name == "variant")
        settings.variant = choiceOf<Variant>(entry, where);
    else if (entry.name == "quasi-specular")
        settings.quasiSpecular = parseQuasiSpecular(entry, where);
    else if (entry.name == "direct")
        settings.direct = choiceOf<DirectLight>(entry, where);
    else if (entry.name == "caustics")
        settings.caustics = choiceOf<CausticLight>(entry, where);
    else if (entry.name == "map")
        settings.map = choiceOf<MapOrder>(entry, where);
    else if (entry.name == "units")
        settings.units = choiceOf<Units>(entry, where);
    else if (entry.name == "instances")
        settings.instances = choiceOf<InstanceLevels>(entry, where);
    else if (entry.name == "photons")
        settings.photons = static_cast<unsigned>(parseUnsigned(entry.value, 1, photonsLimit, where, "photons"));
    else if (entry.name == "camera-paths")
        settings.cameraPaths =
            static_cast<unsigned>(parseUnsigned(entry.value, 1, cameraPathsLimit, where, "camera-paths"));
    else if (entry.name == "camera-sampling")
        settings.cameraSampling = choiceOf<CameraSampling>(entry, where);
    else if (entry.name == "seed")
        settings.seed = parseUnsigned(entry.value, 0, std::numeric_limits<uint64_t>::max(), where, "seed");
    else
        throw InputError(where, fmt::format("unknown key '{}' of <?quasilux?> in a scene.{}", entry.name,
                                            knownNames(entry.name, settingNames)));
}

} // namespace

SceneSettings parseSceneSettings(const std::vector<Instruction>& instructions) {
    SceneSettings settings;
    std::set<std::string> given;
    for (const Instruction& instruction : instructions) {
        for (const Attribute& entry : instruction.entries) {
            if (!given.insert(entry.name).second)
                throw InputError(instruction.where,
                                 fmt::format("<?quasilux?> sets '{}' a second time; keep one.", entry.name));
            apply(entry, instruction.where, settings);
        }
    }
    return settings;
}

} // namespace quasilux
