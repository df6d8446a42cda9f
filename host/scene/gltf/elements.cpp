#include "scene/gltf/elements.h"

#include <fmt/format.h>
#include <utility>

namespace quasilux {

namespace {

void addParameter(Element& object, const std::string& tag, const std::string& name, std::string value) {
    Element parameter;
    parameter.tag = tag;
    parameter.attributes = {{"name", name}, {"value", std::move(value)}};
    parameter.where = object.where;
    object.children.push_back(std::move(parameter));
}

std::string textOf(const glm::dvec3& value) { return fmt::format("{}, {}, {}", value.x, value.y, value.z); }

} // namespace

Element newObject(const std::string& tag, const std::string& type, const std::string& id, const SourceLocation& where) {
    Element object;
    object.tag = tag;
    object.attributes = {{"type", type}};
    if (!id.empty()) object.attributes.push_back({"id", id});
    object.where = where;
    return object;
}

void addNumber(Element& object, const std::string& name, double value) {
    addParameter(object, "float", name, fmt::format("{}", value));
}

void addWhole(Element& object, const std::string& name, int64_t value) {
    addParameter(object, "integer", name, fmt::format("{}", value));
}

void addFlag(Element& object, const std::string& name, bool value) {
    addParameter(object, "boolean", name, value ? "true" : "false");
}

void addText(Element& object, const std::string& name, const std::string& value) {
    addParameter(object, "string", name, value);
}

void addColor(Element& object, const std::string& name, const glm::dvec3& value) {
    addParameter(object, "rgb", name, textOf(value));
}

void addPoint(Element& object, const std::string& name, const glm::dvec3& value) {
    addParameter(object, "point", name, textOf(value));
}

void addMatrix(Element& object, const std::string& name, const glm::dmat4& matrix) {
    std::string entries;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            entries += fmt::format("{}{}", entries.empty() ? "" : " ", matrix[column][row]);
    Element operation, transform;
    operation.tag = "matrix";
    operation.attributes = {{"value", entries}};
    operation.where = transform.where = object.where;
    transform.tag = "transform";
    transform.attributes = {{"name", name}};
    transform.children.push_back(std::move(operation));
    object.children.push_back(std::move(transform));
}

void addReference(Element& object, const std::string& name, const std::string& id) {
    Element reference;
    reference.tag = "ref";
    reference.attributes = {{"id", id}};
    if (!name.empty()) reference.attributes.push_back({"name", name});
    reference.where = object.where;
    object.children.push_back(std::move(reference));
}

void addNested(Element& object, const std::string& name, Element nested) {
    if (!name.empty()) nested.attributes.push_back({"name", name});
    object.children.push_back(std::move(nested));
}

} // namespace quasilux
