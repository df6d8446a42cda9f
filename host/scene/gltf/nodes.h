// The nodes of a glTF file and where their parents put them.
#pragma once

#include "scene/gltf/gltf_context.h"

#include <glm/glm.hpp>

namespace quasilux {

struct PlacedNode {
    size_t index = 0;
    glm::dmat4 toWorld{1};
};

/// Those of the file's scene, parents first; of all nodes where it has no scene. Throws InputError, also for nodes that
/// are not a tree.
std::vector<PlacedNode> placeNodes(const GltfContext& context);

/// The scene that is shown, or nullptr where the file has none.
const tinygltf::Scene* shownScene(const GltfContext& context);

/// Where the node puts its mesh: once, or as often as EXT_mesh_gpu_instancing says.
std::vector<glm::dmat4> placesOfMesh(const GltfContext& context, const PlacedNode& node);

/// Place and axes without scale, shear and mirroring, for cameras and lights.
glm::dmat4 rigid(const glm::dmat4& toWorld, const SourceLocation& where);

} // namespace quasilux
