// The tree of a scene file after includes and `$parameters` are resolved: tags and attributes, no meaning yet.
#pragma once

#include "util/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace quasilux {

struct Attribute {
    std::string name, value;
};

/// `<?quasilux key="value" …?>`, or `<?quasilux kind key="value" …?>`
struct Instruction {
    std::vector<Attribute> entries;
    SourceLocation where;
    std::string kind = {}; ///< empty: settings
};

struct Element {
    std::string tag;
    std::vector<Attribute> attributes;
    std::vector<Element> children;
    std::vector<Instruction> instructions;
    SourceLocation where;

    /// Value of an attribute, or nullptr.
    const std::string* find(std::string_view name) const {
        for (const Attribute& attribute : attributes)
            if (attribute.name == name) return &attribute.value;
        return nullptr;
    }
    /// Value of an attribute, empty where it is missing.
    const std::string& get(std::string_view name) const {
        static const std::string none;
        const std::string* value = find(name);
        return value ? *value : none;
    }
};

} // namespace quasilux
