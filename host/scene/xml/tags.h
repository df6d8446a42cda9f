// Every XML tag of the scene language with its attributes: one line each in tags.cpp.
#pragma once

#include "scene/xml/element.h"
#include "scene/xml/names.h"

namespace quasilux {

enum class TagKind { scene, object, parameter, transform, operation, reference, directive };

struct Tag {
    std::string_view name;
    TagKind kind;
    Names required, optional;
};

/// The tag of `element`. Throws InputError for an unknown or unsupported tag.
const Tag& tagOf(const Element& element);

bool isKnownTag(std::string_view name);

/// Elements within elements at most, as those who read them recurse.
inline constexpr int maximumNesting = 64;

[[noreturn]] void throwNesting(const Element& element);

/// Checks tag and attributes of `element` and whether it may stand in `parent` (nullptr: root of a file).
void checkElement(const Element& element, const Element* parent);
/// The same of all that stand in it, for a tree that comes from no file. Throws InputError.
void checkTree(const Element& root);

} // namespace quasilux
