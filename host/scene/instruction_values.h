// Values of `<?quasilux KIND key="value" …?>`.
#pragma once

#include "scene/xml/element.h"
#include "scene/xml/names.h"

#include <glm/glm.hpp>

namespace quasilux {

class InstructionValues {
public:
    /// Throws InputError for keys that are not `known`. `expected` says in messages what such an instruction needs.
    InstructionValues(const Instruction& instruction, const Names& known, std::string expected);

    bool has(std::string_view key) const { return find(key) != nullptr; }
    /// The others throw InputError where the key is missing, or its value is none.
    const std::string& text(std::string_view key) const;
    glm::dvec3 vector(std::string_view key) const;
    unsigned count(std::string_view key, unsigned most) const;
    double numberAbove(std::string_view key, double lowest) const;

private:
    const std::string* find(std::string_view key) const;

    const Instruction& instruction_;
    std::string expected_;
};

} // namespace quasilux
