// `<?quasilux quasi-specular="…"?>` in a bsdf.
#include "scene/quasi_specular.h"

#include "scene/xml/names.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

void checkLobes(const QuasiSpecularChoice& choice, const Names& lobes, const SourceLocation& where) {
    for (const std::string& name : choice.lobes)
        if (std::find(lobes.begin(), lobes.end(), name) == lobes.end())
            throw InputError(
                where, fmt::format("quasi-specular: this bsdf has no lobe '{}'; expected auto, yes, no, or lobes of "
                                   "it.{}",
                                   name, knownNames(name, lobes)));
}

QuasiSpecularChoice parseChoice(const std::string& text, const SourceLocation& where) {
    using Kind = QuasiSpecularChoice::Kind;
    QuasiSpecularChoice choice;
    choice.stated = true;
    if (text.compare(0, 6, "level:") == 0)
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

} // namespace

void applyQuasiSpecular(const Element& bsdf, std::vector<LobeDescription>& front, std::vector<LobeDescription>& back) {
    if (bsdf.instructions.size() > 1)
        throw InputError(bsdf.instructions[1].where, "a second <?quasilux?> in one bsdf; keep one.");
    Names lobes;
    for (const auto* side : {&front, &back})
        for (const LobeDescription& lobe : *side)
            if (std::find(lobes.begin(), lobes.end(), lobe.name) == lobes.end()) lobes.push_back(lobe.name);
    for (const Instruction& instruction : bsdf.instructions) {
        for (const Attribute& entry : instruction.entries) {
            if (entry.name != "quasi-specular")
                throw InputError(instruction.where,
                                 fmt::format("unknown key '{}' of <?quasilux?> in a bsdf.{}", entry.name,
                                             knownNames(entry.name, {"quasi-specular"})));
            const QuasiSpecularChoice choice = parseChoice(entry.value, instruction.where);
            checkLobes(choice, lobes, instruction.where);
            for (auto* side : {&front, &back})
                for (LobeDescription& lobe : *side)
                    if (!lobe.quasiSpecular.stated) lobe.quasiSpecular = choice;
        }
    }
}

} // namespace quasilux
