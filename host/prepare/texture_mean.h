// Mean of a texture where an emitter shines, by which emitters are chosen. Paths look textures up by kernels/texture.clh.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace quasilux {

/// The texture at `uv`, as the kernels look it up.
glm::dvec3 textureValue(const TextureDescription& texture, glm::dvec2 uv);

/// A place with its weight.
struct TexturePlace {
    glm::dvec2 uv{};
    double weight = 1;
};
/// Weighted mean over the unit square that `placeAt` takes to the texture, by as many samples as it has pixels, within reason. Above 0 in
/// some channel wherever a pixel is.
Rgb meanOfTexture(const TextureDescription& texture, const std::function<TexturePlace(double x, double y)>& placeAt);
/// Mean by area over a mesh with texture coordinates, likewise.
Rgb meanOfTexture(const TextureDescription& texture, const Mesh& mesh);

} // namespace quasilux
