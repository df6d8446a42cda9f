// <emitter type="spot">: a point that shines into a cone.
#include "scene/emitters/emitters.h"
#include "scene/textures/texture_plugin.h"
#include "scene/transform.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr double radians = std::numbers::pi / 180;
// Narrower, the edge of a cone without a transition would be lost in rounding.
constexpr double leastTransition = 1e-6;

/// From the axis to the rim of the texture, along local x or y, over its square: the cone reaches from edge to edge.
/// Wider than a half space it does so behind the point, as in Mitsuba.
glm::vec3 acrossCone(const glm::dmat4& toWorld, int axis, double cutoff) {
    glm::dvec3 local(0);
    local[axis] = 1;
    return glm::vec3(glm::normalize(transformVector(toWorld, local)) * (0.5 / std::tan(cutoff * radians)));
}

} // namespace

glm::dmat4 roundPlacement(Properties& properties) {
    const glm::dmat4 toWorld = properties.transform("to_world");
    const glm::dmat3 turn(toWorld);
    if (!keepsAngles(turn, glm::dot(turn[0], turn[0]), 1e-3))
        throw InputError(
            properties.where("to_world"),
            fmt::format("the to_world of an emitter '{}' shears it, or scales directions differently; use a "
                        "rotation and a translation, or lookat.",
                        properties.plugin()));
    return toWorld;
}

SceneEmitter readSpot(Properties& properties) {
    const glm::dmat4 toWorld = roundPlacement(properties);
    const double cutoff = properties.numberAbove("cutoff_angle", 20, 0, true);
    const double beam = properties.numberAbove("beam_width", 0.75 * cutoff, 0, false);
    if (cutoff > 180)
        throw InputError(
            properties.where("cutoff_angle"),
            fmt::format("parameter 'cutoff_angle' is {}; expected degrees from the axis, at most 180.", cutoff));
    PointEmitter emitter = pointEmitterAt(transformPoint(toWorld, glm::dvec3(0)), properties);
    emitter.spot = {glm::vec3(glm::normalize(transformVector(toWorld, {0, 0, 1}))),
                    std::min(beam * radians, cutoff * radians * (1 - leastTransition)), cutoff * radians};
    const EmissionColor picture = readEmission(properties, "texture", {1, 1, 1}, false);
    emitter.intensity = emitter.intensity * picture.scale;
    if (picture.texture)
        emitter.picture = {acrossCone(toWorld, 0, cutoff), acrossCone(toWorld, 1, cutoff), picture.texture};
    return emitter;
}

} // namespace quasilux
