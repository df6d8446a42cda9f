// Textures of glTF materials as <texture type="bitmap">.
#pragma once

#include "scene/gltf/images.h"
#include "scene/xml/element.h"

#include <optional>

namespace quasilux {

/// What a parameter of a bsdf or an emitter is: a value, or a texture of the scene by its id.
struct GltfParameter {
    glm::dvec3 value{};
    std::string texture; ///< empty: the value
    bool isTextured() const { return !texture.empty(); }
};

class GltfTextures {
public:
    GltfTextures(GltfContext& context, Element& scene) : context_(context), images_(context), scene_(scene) {}

    /// The texture with `change` made to its pixels; it is put into the scene once. `where`: of the material. Throws
    /// InputError.
    GltfParameter make(const tinygltf::TextureInfo& texture, PixelCode code, const std::string& meaning,
                       const PixelChange& change, const SourceLocation& where);
    /// The set of texture coordinates that it is laid out by.
    static int texCoordOf(const tinygltf::TextureInfo& texture, const SourceLocation& where);

private:
    int imageOf(const tinygltf::TextureInfo& texture, const SourceLocation& where) const;

    GltfContext& context_;
    GltfImages images_;
    Element& scene_;
    std::map<std::string, std::string> ids_; ///< by image, sampler and transform
};

} // namespace quasilux
