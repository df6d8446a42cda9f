// Primitives of glTF meshes as meshes of the scene.
#pragma once

#include "scene/gltf/gltf_context.h"
#include "scene/shapes/mesh_builder.h"

#include <optional>

namespace quasilux {

/// How its material looks at a primitive.
struct PrimitiveUse {
    int texCoord = 0;                 ///< the set of texture coordinates
    glm::dvec4 colorFactor{1};        ///< on vertex colours, which become the attributes vertex_color and vertex_alpha
    bool needsRoots = false;          ///< of these colours, as the attribute vertex_color_root
    std::vector<double> morphWeights; ///< of its targets
    SourceLocation where;             ///< of the primitive
};

bool hasVertexColors(const tinygltf::Primitive& primitive);
/// Whether the vertex colours have an alpha.
bool hasVertexAlpha(const GltfContext& context, const tinygltf::Primitive& primitive);
bool hasNormals(const tinygltf::Primitive& primitive);

/// In its own space; null where it has no triangles. Throws InputError.
std::shared_ptr<const MeshSource> readPrimitive(GltfContext& context, const tinygltf::Primitive& primitive,
                                                const PrimitiveUse& use);

} // namespace quasilux
