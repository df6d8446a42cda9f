// Ids, references and warnings.
#include "scene/load_context.h"

#include "scene/xml/names.h"
#include "scene/xml/tags.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

LoadContext::LoadContext(const Element& root, const FileResolver& resolver, Scene& target)
    : scene(target), files(resolver) {
    collect(root);
    collectAliases(root);
}

void LoadContext::add(const std::string& id, const Element& named, const SourceLocation& where) {
    if (id.empty()) throw InputError(where, "the id is empty; leave it out or give a name.");
    const auto [before, isNew] = ids_.emplace(id, &named);
    if (!isNew)
        throw InputError(where, fmt::format("the id '{}' is already in use at {}; ids must differ.", id,
                                            before->second->where.text()));
}

void LoadContext::collect(const Element& element) {
    const bool isMention = element.tag == "ref" || element.tag == "alias";
    if (const std::string* id = isMention ? nullptr : element.find("id")) add(*id, element, element.where);
    for (const Element& child : element.children) collect(child);
}

// In the order of the file: an alias may have an alias.
void LoadContext::collectAliases(const Element& root) {
    for (const Element& child : root.children)
        if (child.tag == "alias") add(child.get("as"), find(child.get("id"), child.where), child.where);
}

const Element& LoadContext::find(const std::string& id, const SourceLocation& where) const {
    const auto found = ids_.find(id);
    if (found != ids_.end()) return *found->second;
    Names known;
    for (const auto& entry : ids_) known.push_back(entry.first);
    std::sort(known.begin(), known.end());
    throw InputError(where, fmt::format("no object has the id '{}'.{}", id, knownNames(id, known)));
}

const Element& LoadContext::resolve(const Element& element) const {
    return element.tag == "ref" ? find(element.get("id"), element.where) : element;
}

void LoadContext::warn(const SourceLocation& where, const std::string& message) {
    scene.warnings.push_back(asMessage(where.text() + ": " + message));
}

void LoadContext::refuseUnknown(const SourceLocation& where, const std::string& message, const std::string& instead) {
    if (unknown == Unknown::refused) throw InputError(where, message);
    forgiven.push_back(asMessage(fmt::format("{}: {} It is {}.", where.text(), message, instead)));
}

// Each reference is read where it stands: a sum of two references to a sum of two references … doubles at each level.
void LoadContext::enter(const Element& element, std::vector<const Element*>& open) {
    constexpr unsigned mostNestedReads = 1000000;
    if (std::find(open.begin(), open.end(), &element) != open.end())
        throw InputError(element.where,
                         fmt::format("{} '{}' contains itself; remove one <ref>.", element.tag, idOf(element)));
    if (open.size() > maximumNesting)
        throw InputError(element.where, fmt::format("{} '{}' lies within more than {} others; nest fewer of them.",
                                                    element.tag, idOf(element), maximumNesting));
    if (!open.empty() && ++nestedReads_ > mostNestedReads)
        throw InputError(element.where,
                         fmt::format("{} '{}': with their references, objects within others come to more than {}; use "
                                     "fewer references.",
                                     element.tag, idOf(element), mostNestedReads));
    open.push_back(&element);
}

std::string idOf(const Element& element) {
    const std::string* id = element.find("id");
    return id ? *id : fmt::format("{}@{}", element.get("type"), element.where.line);
}

} // namespace quasilux
