// Reading of emitters. A new plugin is one file here and one line in the table of emitters.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Whether the plugin is unknown, and forgiven.
bool leavesOutEmitter(const Element& element, LoadContext& context);
/// Whether its plugin is one for shapes: directly in the scene it is there to be referenced.
bool isShapeEmitter(const Element& element);
/// The emitter nested in a shape. Throws InputError unless it is an `area` emitter.
AreaEmitter readShapeEmitter(const Element& element, LoadContext& context);
/// An emitter of its own, directly in the scene; it is added to context.scene.
void readSceneEmitter(const Element& element, LoadContext& context);

/// The scene's surroundings, still without radiance. Throws InputError where it has some already.
Surroundings& addSurroundings(Properties& properties);

/// A point that shines with `intensity`, in the medium that is stated.
PointEmitter pointEmitterAt(const glm::dvec3& position, Properties& properties);

AreaEmitter readArea(Properties& properties);
void readConstant(Properties& properties);
void readEnvmap(Properties& properties);
void readDirectional(Properties& properties);
void readPoint(Properties& properties);
void readSpot(Properties& properties);

} // namespace quasilux
