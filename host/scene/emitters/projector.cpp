// <emitter type="projector">: a point that throws a picture, as a camera would see it.
#include "scene/emitters/emitters.h"
#include "scene/sensors/field_of_view.h"
#include "scene/textures/texture_plugin.h"
#include "scene/transform.h"

#include <cmath>
#include <numbers>

namespace quasilux {

namespace {

/// Width over height of the texture's pixels; of what has none 1.
double aspectOf(const EmissionColor& picture, const Scene& scene) {
    if (!picture.texture) return 1;
    const shared::Texture& texture = scene.textures[*picture.texture].device;
    return texture.type == TEXTURE_BITMAP ? double(texture.width) / texture.height : 1;
}

} // namespace

SceneEmitter readProjector(Properties& properties) {
    const glm::dmat4 toWorld = roundPlacement(properties);
    const double scale = properties.numberAbove("scale", 1, 0, false);
    const EmissionColor picture = readEmission(properties, "irradiance", {1, 1, 1}, false);
    const double aspect = aspectOf(picture, properties.context().scene);
    const double halfWidth = std::tan(readFieldOfView(properties, aspect) / 2); // at depth 1

    PointEmitter emitter = darkPointAt(transformPoint(toWorld, glm::dvec3(0)), properties);
    const glm::dvec3 axis = transformVector(toWorld, {0, 0, 1});
    // As Mitsuba 3.9 has it: pi times the irradiance, and a scale of to_world multiplies it once more.
    emitter.intensity = picture.scale * static_cast<float>(std::numbers::pi * scale * glm::length(axis));
    // Like the image of a camera: local +x to its left, +y up.
    const glm::dvec3 u = glm::normalize(transformVector(toWorld, {-1, 0, 0})) * (0.5 / halfWidth);
    const glm::dvec3 v = glm::normalize(transformVector(toWorld, {0, -1, 0})) * (0.5 * aspect / halfWidth);
    emitter.projector = {glm::vec3(glm::normalize(axis)), {glm::vec3(u), glm::vec3(v), picture.texture}};
    return emitter;
}

} // namespace quasilux
