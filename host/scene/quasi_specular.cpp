// `<?quasilux quasi-specular="…"?>` in a bsdf or a medium.
#include "scene/quasi_specular.h"

#include "scene/xml/names.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr std::string_view levelPrefix = "level:";

void checkLobes(const QuasiSpecularChoice& choice, const Names& lobes, const SourceLocation& where) {
    for (const std::string& name : choice.lobes)
        if (std::find(lobes.begin(), lobes.end(), name) == lobes.end())
            throw InputError(
                where, fmt::format("quasi-specular: this bsdf has no lobe '{}'; expected auto, yes, no, or lobes of "
                                   "it.{}",
                                   name, knownNames(name, lobes)));
}

QuasiSpecularChoice parseForBsdf(const std::string& text, const SourceLocation& where) {
    using Kind = QuasiSpecularChoice::Kind;
    QuasiSpecularChoice choice;
    choice.stated = true;
    if (isPhaseLevel(text))
        throw InputError(
            where, fmt::format("quasi-specular=\"{}\": a level splits phase functions; for a bsdf give auto, yes, "
                               "no, or names of its lobes.",
                               text));
    if (text == "auto") return choice;
    if (text == "yes" || text == "no") {
        choice.kind = text == "yes" ? Kind::yes : Kind::no;
        return choice;
    }
    choice.kind = Kind::lobes;
    for (std::string_view name : splitList(text)) choice.lobes.emplace_back(name);
    if (choice.lobes.empty())
        throw InputError(where, "quasi-specular is empty; expected auto, yes, no, or names of lobes.");
    return choice;
}

QuasiSpecularChoice parseForMedium(const std::string& text, const SourceLocation& where) {
    using Kind = QuasiSpecularChoice::Kind;
    QuasiSpecularChoice choice;
    choice.stated = true;
    if (isPhaseLevel(text)) {
        choice.kind = Kind::level;
        choice.level = parsePhaseLevel(text, where);
    } else if (text == "yes" || text == "no") {
        choice.kind = text == "yes" ? Kind::yes : Kind::no;
    } else if (text != "auto") {
        throw InputError(where, fmt::format("quasi-specular=\"{}\" of a medium: expected auto, yes, no, or a level "
                                            "such as level:0.1.",
                                            text));
    }
    return choice;
}

/// The one entry of the instructions of `object`, or nullptr.
const Attribute* findEntry(const Element& object) {
    if (object.instructions.size() > 1)
        throw InputError(object.instructions[1].where,
                         fmt::format("a second <?quasilux?> in one {}; keep one.", object.tag));
    const Attribute* found = nullptr;
    for (const Instruction& instruction : object.instructions) {
        for (const Attribute& entry : instruction.entries) {
            if (entry.name != "quasi-specular")
                throw InputError(instruction.where,
                                 fmt::format("unknown key '{}' of <?quasilux?> in a {}.{}", entry.name, object.tag,
                                             knownNames(entry.name, {"quasi-specular"})));
            found = &entry;
        }
    }
    return found;
}

} // namespace

void applyQuasiSpecular(const Element& bsdf, std::vector<LobeDescription>& front, std::vector<LobeDescription>& back) {
    const Attribute* entry = findEntry(bsdf);
    if (!entry) return;
    Names lobes;
    for (const auto* side : {&front, &back})
        for (const LobeDescription& lobe : *side)
            if (std::find(lobes.begin(), lobes.end(), lobe.name) == lobes.end()) lobes.push_back(lobe.name);
    const SourceLocation& where = bsdf.instructions.front().where;
    const QuasiSpecularChoice choice = parseForBsdf(entry->value, where);
    checkLobes(choice, lobes, where);
    for (auto* side : {&front, &back})
        for (LobeDescription& lobe : *side)
            if (!lobe.quasiSpecular.stated) lobe.quasiSpecular = choice;
}

QuasiSpecularChoice readMediumQuasiSpecular(const Element& medium) {
    const Attribute* entry = findEntry(medium);
    return entry ? parseForMedium(entry->value, medium.instructions.front().where) : QuasiSpecularChoice{};
}

bool isPhaseLevel(std::string_view text) { return text.substr(0, levelPrefix.size()) == levelPrefix; }

double parsePhaseLevel(std::string_view text, const SourceLocation& where) {
    const double level = parseNumber(text.substr(levelPrefix.size()), where, "quasi-specular: level");
    const float single = static_cast<float>(level);
    if (!(single > 0) || !std::isfinite(single))
        throw InputError(where, fmt::format("quasi-specular: level {} is out of range; expected sr^-1 above 0, such as "
                                            "level:0.1.",
                                            level));
    return level;
}

} // namespace quasilux
