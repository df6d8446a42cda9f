// Elements of the scene language, as the reader of XML makes them.
#pragma once

#include "scene/xml/element.h"

#include <glm/glm.hpp>
#include <string>

namespace quasilux {

/// <tag type="…" id="…">, without an id where it is empty.
Element newObject(const std::string& tag, const std::string& type, const std::string& id, const SourceLocation& where);

// Parameters of `object`.
void addNumber(Element& object, const std::string& name, double value);
void addWhole(Element& object, const std::string& name, int64_t value);
void addFlag(Element& object, const std::string& name, bool value);
void addText(Element& object, const std::string& name, const std::string& value);
void addColor(Element& object, const std::string& name, const glm::dvec3& value);
void addPoint(Element& object, const std::string& name, const glm::dvec3& value);
void addMatrix(Element& object, const std::string& name, const glm::dmat4& matrix);
/// Another object, by its id; `name` may be empty.
void addReference(Element& object, const std::string& name, const std::string& id);
/// A nested object, as the parameter `name` unless that is empty.
void addNested(Element& object, const std::string& name, Element nested);

} // namespace quasilux
