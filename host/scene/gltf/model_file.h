// Reads .gltf and .glb files by tinygltf: what they say, not yet what it means.
#pragma once

#include "scene/scene.h"
#include "scene/xml/file_resolver.h"

#include <tiny_gltf.h>

namespace quasilux {

/// Images are as encoded in their files; those within buffers are left there. `forgiven` gets the required extensions
/// that are unknown, where `unknown` forgives them. Throws InputError.
tinygltf::Model readGltfModel(const std::string& path, const FileResolver& files, Unknown unknown,
                              std::vector<std::string>& forgiven);

/// Whether what the extension says has an effect here.
bool isKnownGltfExtension(const std::string& name);

} // namespace quasilux
