// Reading of emitters. A new plugin is one file here and one line in the table of emitters.cpp
// (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

#include <variant>

namespace quasilux {

/// What a plugin that stands alone makes; a sky may add the sun to the scene besides.
using SceneEmitter = std::variant<PointEmitter, DirectionalEmitter, Surroundings>;

/// Whether the plugin is unknown, and forgiven.
bool leavesOutEmitter(const Element& element, LoadContext& context);
/// Whether its plugin is one for shapes: directly in the scene it is there to be referenced.
bool isShapeEmitter(const Element& element);
/// The emitter nested in a shape; nothing, with a warning, where it is off. Throws InputError unless it is an `area` or
/// `directionalarea` emitter.
std::optional<AreaEmitter> readShapeEmitter(const Element& element, LoadContext& context);
/// An emitter of its own, directly in the scene; it is added to context.scene, or left out with a warning where it is off.
void readSceneEmitter(const Element& element, LoadContext& context);

/// Surroundings without radiance. Throws InputError where the scene has some already.
Surroundings newSurroundings(Properties& properties);
/// Of their `to_world`, the nearest axes at right angles. Throws InputError where they are not nearly so, or scaled.
glm::dmat3 axesOfSurroundings(Properties& properties);

/// A point in the medium that is stated, without an intensity; and one that shines with `intensity`.
PointEmitter darkPointAt(const glm::dvec3& position, Properties& properties);
PointEmitter pointEmitterAt(const glm::dvec3& position, Properties& properties);
/// Without a shear or different scales a cone stays a cone. Throws InputError where `to_world` has them.
glm::dmat4 roundPlacement(Properties& properties);
/// Of `tint` or `colour_temperature`, with luminance 1; white where neither is given.
Rgb readLightColour(Properties& properties);
/// Are the scene's units photometric?
bool isPhotometric(const Properties& properties);
/// Radiant units by photometric ones: 1 / (683 lm/W), or 1 where the scene's units are photometric.
double radiantFactor(const Properties& properties);

Names emitterPluginNames();

AreaEmitter readArea(Properties& properties);
AreaEmitter readDirectionalArea(Properties& properties);
SceneEmitter readConstant(Properties& properties);
SceneEmitter readEnvmap(Properties& properties);
SceneEmitter readLuminaire(Properties& properties);
SceneEmitter readCieSky(Properties& properties);
SceneEmitter readPerezSky(Properties& properties);
SceneEmitter readDirectional(Properties& properties);
SceneEmitter readPoint(Properties& properties);
SceneEmitter readProjector(Properties& properties);
SceneEmitter readSpot(Properties& properties);
SceneEmitter readSunSky(Properties& properties);

} // namespace quasilux
