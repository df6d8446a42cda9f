// Ids, references and warnings.
#include "scene/load_context.h"

#include "scene/xml/names.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

LoadContext::LoadContext(const Element& root, Scene& target) : scene(target) { collect(root); }

void LoadContext::collect(const Element& element) {
    const std::string* id = element.tag == "ref" ? nullptr : element.find("id");
    if (id) {
        if (id->empty()) throw InputError(element.where, "the id is empty; leave it out or give a name.");
        const auto [before, isNew] = ids_.emplace(*id, &element);
        if (!isNew)
            throw InputError(element.where, fmt::format("the id '{}' is already in use at {}; ids must differ.", *id,
                                                        before->second->where.text()));
    }
    for (const Element& child : element.children) collect(child);
}

const Element& LoadContext::resolve(const Element& element) const {
    if (element.tag != "ref") return element;
    const std::string& id = element.get("id");
    const auto found = ids_.find(id);
    if (found != ids_.end()) return *found->second;
    Names known;
    for (const auto& entry : ids_) known.push_back(entry.first);
    std::sort(known.begin(), known.end());
    throw InputError(element.where, fmt::format("no object has the id '{}'.{}", id, knownNames(id, known)));
}

void LoadContext::warn(const SourceLocation& where, const std::string& message) {
    scene.warnings.push_back(where.text() + ": " + message);
}

std::string idOf(const Element& element) {
    const std::string* id = element.find("id");
    return id ? *id : fmt::format("{}@{}", element.get("type"), element.where.line);
}

} // namespace quasilux
