#include "python/scene_tree.h"

#include "scene/xml/tags.h"

namespace quasilux {

namespace py = pybind11;

namespace {

std::vector<Attribute> attributesOf(const py::handle& pairs) {
    std::vector<Attribute> attributes;
    for (const auto& pair : py::cast<py::dict>(pairs))
        attributes.push_back({py::cast<std::string>(pair.first), py::cast<std::string>(pair.second)});
    return attributes;
}

Instruction instructionOf(const py::handle& node) {
    const auto fields = py::cast<py::tuple>(node);
    Instruction instruction;
    instruction.kind = py::cast<std::string>(fields[0]);
    instruction.entries = attributesOf(fields[1]);
    instruction.where.file = py::cast<std::string>(fields[2]);
    return instruction;
}

} // namespace

Element elementOf(const py::handle& node) {
    const auto fields = py::cast<py::tuple>(node);
    Element element;
    element.tag = py::cast<std::string>(fields[0]);
    element.attributes = attributesOf(fields[1]);
    for (const auto& child : fields[2]) element.children.push_back(elementOf(child));
    for (const auto& instruction : fields[3]) element.instructions.push_back(instructionOf(instruction));
    element.where.file = py::cast<std::string>(fields[4]);
    return element;
}

SceneDocument documentOf(const py::handle& root, const std::string& folder) {
    SceneDocument document{elementOf(root), FileResolver(folder + "/scene"), {}};
    checkTree(document.root);
    return document;
}

} // namespace quasilux
