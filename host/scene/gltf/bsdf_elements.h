// The <bsdf> and the <medium> that stand for a glTF material.
#pragma once

#include "scene/gltf/material_values.h"
#include "scene/gltf/textures.h"

namespace quasilux {

/// What of a primitive a material depends on.
struct PrimitiveSurface {
    bool hasUvs = false, hasColors = false, hasAlpha = false; ///< of vertex colours
    auto operator<=>(const PrimitiveSurface&) const = default;
};

/// Textures of attributes of meshes, which the scene has once where any bsdf needs them.
inline constexpr const char *vertexColorId = "vertex colours", *vertexRootId = "roots of vertex colours",
                            *vertexAlphaId = "vertex alpha";

/// What the parameters of a material come to at such primitives.
struct GltfSurface {
    GltfParameter base, roughness, metallic, transmission, opacity;
    std::optional<GltfParameter> normal;
    GltfParameter transmitted; ///< colour of what is transmitted at one border
    GltfParameter alpha;       ///< roughness squared
    GltfParameter coat, coatGloss;
    GltfParameter specular; ///< share of the reflectance that the material's index and factor have
};

GltfSurface surfaceOf(const GltfMaterial& material, const PrimitiveSurface& primitive, GltfContext& context,
                      GltfTextures& textures);

/// A <bsdf> with this id.
Element bsdfOf(const GltfMaterial& material, const GltfSurface& surface, const std::string& id);

/// What the body absorbs, or nothing.
std::optional<Element> mediumOf(const GltfMaterial& material, const std::string& id);

} // namespace quasilux
