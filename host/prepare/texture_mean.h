// Mean of a texture where an emitter shines, by which emitters are chosen. Paths look textures up by
// kernels/texture.clh.
#pragma once

#include "scene/scene.h"

#include <functional>

namespace quasilux {

/// The texture at `uv`, as the kernels look it up; those within it are of `all`. Of attributes and volumes within it a
/// mean.
glm::dvec3 textureValue(const TextureDescription& texture, const std::vector<TextureDescription>& all, glm::dvec2 uv);

/// A place with its weight.
struct TexturePlace {
    glm::dvec2 uv{};
    double weight = 1;
};
/// Weighted mean over the unit square that `placeAt` takes to the texture, by as many samples as it has pixels, within
/// reason. Above 0 in some channel wherever a pixel is.
Rgb meanOfTexture(const TextureDescription& texture, const std::vector<TextureDescription>& all,
                  const std::function<TexturePlace(double x, double y)>& placeAt);
/// Mean by area over a mesh, likewise; of a volume that of all its values.
Rgb meanOfTexture(const TextureDescription& texture, const std::vector<TextureDescription>& all, const Mesh& mesh);

} // namespace quasilux
