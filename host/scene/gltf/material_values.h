// What a material of a glTF file says, with its extensions, in range.
#pragma once

#include "scene/gltf/gltf_context.h"

#include <glm/glm.hpp>
#include <limits>

namespace quasilux {

enum class AlphaMode { opaque, mask, blend };

/// Defaults are those of the specification. A texture without an index is missing.
struct GltfMaterial {
    SourceLocation where;
    std::string name;
    glm::dvec4 baseColor{1};
    tinygltf::TextureInfo baseTexture;
    double metallic = 1, roughness = 1;
    tinygltf::TextureInfo metallicRoughnessTexture; ///< roughness in green, metallic in blue
    tinygltf::TextureInfo normalTexture;
    double normalScale = 1;
    glm::dvec3 emission{0}; ///< cd/m²
    tinygltf::TextureInfo emissiveTexture;
    AlphaMode alphaMode = AlphaMode::opaque;
    double alphaCutoff = 0.5;
    bool doubleSided = false;
    double transmission = 0;
    tinygltf::TextureInfo transmissionTexture; ///< in red
    double ior = 1.5;
    bool hasVolume = false; ///< its surface encloses a body; else it is thin
    double attenuationDistance = std::numeric_limits<double>::infinity();
    glm::dvec3 attenuationColor{1};
    double clearcoat = 0, clearcoatRoughness = 0;
    tinygltf::TextureInfo clearcoatTexture, clearcoatRoughnessTexture; ///< in red, in green
    double specular = 1;                                         ///< factor on the reflectance at normal incidence
    tinygltf::TextureInfo specularTexture, specularColorTexture; ///< in alpha, in R, G, B

    /// Of its textures, those that are there.
    std::vector<const tinygltf::TextureInfo*> textures() const;
};

/// `index` -1: the material of primitives without one. Throws InputError.
GltfMaterial readGltfMaterial(GltfContext& context, int index, const SourceLocation& where);

} // namespace quasilux
