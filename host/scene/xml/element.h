// The tree of a scene file after includes and `$parameters` are resolved: tags and attributes, no meaning yet.
#pragma once

#include "util/error.h"

#include <glm/glm.hpp>
#include <memory>
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

/// Instances of groups that stand before them, which say no more than where: a scene may have millions, so they are no
/// elements.
struct PlainInstances {
    struct One {
        size_t before = 0;       ///< children of the scene that precede it
        unsigned group = 0;      ///< index into groupIds
        int line = 0;            ///< in its file
        glm::dmat4x3 toWorld{1}; ///< as it is written
    };
    std::vector<std::string> groupIds;
    std::vector<One> all;
};

struct Element {
    std::string tag;
    std::vector<Attribute> attributes;
    std::vector<Element> children;
    std::vector<Instruction> instructions;
    SourceLocation where;
    std::shared_ptr<PlainInstances> instances = {}; ///< of a scene; null: none

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
