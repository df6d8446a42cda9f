// What textures of bsdfs and emitters need of the shapes that they are on.
#pragma once

#include "scene/load_context.h"

namespace quasilux {

/// These textures and those that are within them, each once; by index into Scene::textures.
std::vector<unsigned> withNested(const Scene& scene, const std::vector<unsigned>& textures);

/// Whether texture coordinates are asked for: attributes of meshes need none.
bool needsTexCoords(const Scene& scene, const Bsdf& bsdf);

bool needTexCoords(const Scene& scene, const std::vector<unsigned>& textures);

/// What its bsdf and emitter show, nested ones too, each once.
std::vector<unsigned> texturesOf(const Scene& scene, const ShapeDescription& shape);

/// Of a shape's attributes leaves those that its bsdf and emitter show. Throws InputError at the shape where it lacks
/// one, or where one does not fit.
void keepShownAttributes(ShapeDescription& shape, LoadContext& context);

} // namespace quasilux
