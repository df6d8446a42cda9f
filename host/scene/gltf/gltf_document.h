// glTF 2.0 files as scenes (docs/reference/gltf.md): the same tree of elements that the reader of XML makes.
#pragma once

#include "scene/xml/xml_document.h"

namespace quasilux {

/// By the ending of the name: .gltf or .glb.
bool isGltf(const std::string& path);

/// As readSceneDocument. Throws InputError that names the file and the place in its JSON.
SceneDocument readGltfDocument(const std::string& path, const SceneParameters& parameters, Unknown unknown,
                               std::shared_ptr<LoadGuard> guard);

} // namespace quasilux
