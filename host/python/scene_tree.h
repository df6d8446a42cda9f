// Scenes that Python code describes by dicts: the same tree of elements that the XML reader makes.
#pragma once

#include "scene/xml/xml_document.h"

#include <pybind11/pybind11.h>

namespace quasilux {

/// An element of python/quasilux/_tree.py: (tag, attributes, children, instructions, place). The place, such as
/// "scene.lamp.radiance", stands for a file in messages. Throws InputError.
Element elementOf(const pybind11::handle& node);

/// `folder`: where files that the scene names are looked for. Throws InputError.
SceneDocument documentOf(const pybind11::handle& root, const std::string& folder);

} // namespace quasilux
