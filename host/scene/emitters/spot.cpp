// <emitter type="spot">: a point that shines into a cone.
#include "scene/emitters/emitters.h"
#include "scene/transform.h"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {

namespace {

constexpr double radians = std::numbers::pi / 180;
// Narrower, the edge of a cone without a transition would be lost in rounding.
constexpr double leastTransition = 1e-6;

// Without a shear or different scales a cone stays a cone.
void checkRound(const glm::dmat3& toWorld, const SourceLocation& where) {
    if (!keepsAngles(toWorld, glm::dot(toWorld[0], toWorld[0]), 1e-3))
        throw InputError(where, "the to_world of an emitter 'spot' shears it, or scales directions differently; use a "
                                "rotation and a translation, or lookat.");
}

} // namespace

void readSpot(Properties& properties) {
    const glm::dmat4 toWorld = properties.transform("to_world");
    checkRound(glm::dmat3(toWorld), properties.where("to_world"));
    const double cutoff = properties.numberAbove("cutoff_angle", 20, 0, true);
    const double beam = properties.numberAbove("beam_width", 0.75 * cutoff, 0, false);
    if (cutoff > 180)
        throw InputError(
            properties.where("cutoff_angle"),
            fmt::format("parameter 'cutoff_angle' is {}; expected degrees from the axis, at most 180.", cutoff));
    PointEmitter emitter = pointEmitterAt(transformPoint(toWorld, glm::dvec3(0)), properties);
    emitter.spot = {glm::vec3(glm::normalize(transformVector(toWorld, {0, 0, 1}))),
                    std::min(beam * radians, cutoff * radians * (1 - leastTransition)), cutoff * radians};
    if (properties.texture("texture"))
        throw InputError(
            properties.where("texture"),
            "the texture of an emitter 'spot' is not supported; remove it, or use an emitter 'area' behind a shape.");
    properties.context().scene.pointEmitters.push_back(emitter);
}

} // namespace quasilux
