// `<?quasilux …?>` directly in the scene.
#include "scene/settings.h"

#include "scene/quasi_specular.h"
#include "scene/xml/names.h"
#include "scene/xml/numbers.h"

#include <array>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace quasilux {

namespace {

template <NamedChoice Choice>
Choice choiceOf(const Attribute& entry, const SourceLocation& where) {
    if (const auto found = findChoice<Choice>(entry.value)) return *found;
    const auto& names = choiceWords<Choice>.names;
    throw InputError(where, fmt::format("{}: unknown value '{}'.{}", entry.name, entry.value,
                                        knownNames(entry.value, Names(names.begin(), names.end()))));
}

void readQuasiSpecular(const Attribute& entry, const SourceLocation& where, SceneSettings& to) {
    if (isPhaseLevel(entry.value))
        parsePhaseLevel(entry.value, where);
    else if (entry.value == "yes" || entry.value == "no" || splitList(entry.value).empty())
        throw InputError(where, fmt::format("quasi-specular=\"{}\" of a scene: expected auto, none, all, level:NUMBER, "
                                            "or ids of bsdfs and media.",
                                            entry.value));
    to.quasiSpecular = entry.value;
}

template <NamedChoice Choice, std::optional<Choice> SceneSettings::*value>
void readChoice(const Attribute& entry, const SourceLocation& where, SceneSettings& to) {
    to.*value = choiceOf<Choice>(entry, where);
}

template <std::optional<unsigned> SceneSettings::*value, unsigned least, unsigned most>
void readCount(const Attribute& entry, const SourceLocation& where, SceneSettings& to) {
    to.*value = static_cast<unsigned>(parseUnsigned(entry.value, least, most, where, entry.name));
}

void readSeed(const Attribute& entry, const SourceLocation& where, SceneSettings& to) {
    to.seed = parseUnsigned(entry.value, 0, std::numeric_limits<uint64_t>::max(), where, entry.name);
}

struct Key {
    std::string_view name;
    void (*read)(const Attribute& entry, const SourceLocation& where, SceneSettings& to);
};

using S = SceneSettings;
constexpr std::array keys = {
    Key{"bdd", readCount<&S::bdd, 0, bddLimit>},
    Key{"variant", readChoice<Variant, &S::variant>},
    Key{"quasi-specular", readQuasiSpecular},
    Key{"direct", readChoice<DirectLight, &S::direct>},
    Key{"caustics", readChoice<CausticLight, &S::caustics>},
    Key{"map", readChoice<MapOrder, &S::map>},
    Key{"photons", readCount<&S::photons, 1, photonsLimit>},
    Key{"camera-paths", readCount<&S::cameraPaths, 1, cameraPathsLimit>},
    Key{"camera-sampling", readChoice<CameraSampling, &S::cameraSampling>},
    Key{"seed", readSeed},
    Key{"units", readChoice<Units, &S::units>},
    Key{"instances", readChoice<InstanceLevels, &S::instances>},
};

void apply(const Attribute& entry, const SourceLocation& where, SceneSettings& settings) {
    Names names;
    for (const Key& key : keys) {
        if (key.name == entry.name) return key.read(entry, where, settings);
        names.push_back(key.name);
    }
    throw InputError(where, fmt::format("unknown key '{}' of <?quasilux?> in a scene.{}", entry.name,
                                        knownNames(entry.name, names)));
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
