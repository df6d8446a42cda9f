#include "scene/xml/plain_instances.h"

#include "scene/transform.h"

#include <algorithm>

namespace quasilux {

namespace {

/// As they follow each other, mostly the last one.
unsigned indexOf(const std::string& group, PlainInstances& instances) {
    auto& ids = instances.groupIds;
    if (!instances.all.empty() && ids[instances.all.back().group] == group) return instances.all.back().group;
    const auto found = std::find(ids.begin(), ids.end(), group);
    if (found != ids.end()) return static_cast<unsigned>(found - ids.begin());
    ids.push_back(group);
    return static_cast<unsigned>(ids.size() - 1);
}

PlainInstances& instancesOf(Element& scene) {
    if (!scene.instances) scene.instances = std::make_shared<PlainInstances>();
    return *scene.instances;
}

} // namespace

void PlainInstanceReader::note(const Element& element) {
    if (element.tag == "shape" && element.get("type") == "shapegroup" && element.find("id"))
        groups_.insert(element.get("id"));
}

bool PlainInstanceReader::keep(const Element& element, Element& scene) const {
    if (scene.tag != "scene" || element.tag != "shape" || element.get("type") != "instance" ||
        element.attributes.size() != 1)
        return false;
    const std::string* group = nullptr;
    const Element* transform = nullptr;
    for (const Element& child : element.children) {
        if (child.tag == "ref" && !group && child.attributes.size() == 1)
            group = child.find("id");
        else if (child.tag == "transform" && !transform && child.get("name") == "to_world")
            transform = &child;
        else
            return false;
    }
    if (!group || !groups_.contains(*group)) return false;
    PlainInstances::One one;
    try {
        if (transform) one.toWorld = glm::dmat4x3(parseTransform(*transform));
    } catch (const InputError&) { // said when the element is read
        return false;
    }
    PlainInstances& instances = instancesOf(scene);
    one.before = scene.children.size();
    one.group = indexOf(*group, instances);
    one.line = element.where.line;
    instances.all.push_back(one);
    return true;
}

void moveInstances(Element& from, size_t children, Element& to) {
    if (!from.instances) return;
    PlainInstances& instances = instancesOf(to);
    for (PlainInstances::One one : from.instances->all) {
        one.before += children;
        one.group = indexOf(from.instances->groupIds[one.group], instances);
        instances.all.push_back(one);
    }
    from.instances.reset();
}

} // namespace quasilux
