#include "scene/instruction_values.h"

#include "scene/xml/numbers.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// "an illuminance-grid", "an observer".
std::string withArticle(const std::string& kind) {
    const bool isVowel = std::string_view("aeiou").find(kind.front()) != std::string_view::npos;
    return (isVowel ? "an " : "a ") + kind;
}

} // namespace

InstructionValues::InstructionValues(const Instruction& instruction, const Names& known, std::string expected)
    : instruction_(instruction), expected_(std::move(expected)) {
    for (const Attribute& entry : instruction.entries)
        if (std::find(known.begin(), known.end(), entry.name) == known.end())
            throw InputError(instruction.where,
                             fmt::format("unknown key '{}' of {}.{}", entry.name, withArticle(instruction.kind),
                                         knownNames(entry.name, known)));
}

const std::string* InstructionValues::find(std::string_view key) const {
    for (const Attribute& entry : instruction_.entries)
        if (entry.name == key) return &entry.value;
    return nullptr;
}

const std::string& InstructionValues::text(std::string_view key) const {
    if (const std::string* value = find(key)) return *value;
    throw InputError(instruction_.where,
                     fmt::format("the {} lacks {}; expected {}.", instruction_.kind, key, expected_));
}

glm::dvec3 InstructionValues::vector(std::string_view key) const {
    const auto numbers = parseNumbers(text(key), instruction_.where, key);
    if (numbers.size() != 3)
        throw InputError(instruction_.where, fmt::format("{}: {} has {} numbers; expected three, \"x,y,z\".",
                                                         instruction_.kind, key, numbers.size()));
    return {numbers[0], numbers[1], numbers[2]};
}

unsigned InstructionValues::count(std::string_view key, unsigned most) const {
    return static_cast<unsigned>(parseUnsigned(text(key), 1, most, instruction_.where, key));
}

double InstructionValues::numberAbove(std::string_view key, double lowest) const {
    const double value = parseNumber(text(key), instruction_.where, key);
    if (!(value > lowest))
        throw InputError(instruction_.where, fmt::format("{}: {} is {}; expected a number above {}.", instruction_.kind,
                                                         key, value, lowest));
    return value;
}

} // namespace quasilux
