// <emitter type="directional">: parallel light, the same irradiance everywhere across it.
#include "scene/emitters/emitters.h"

namespace quasilux {

SceneEmitter readDirectional(Properties& properties) {
    if (properties.has("direction") && properties.has("to_world"))
        throw InputError(properties.where("to_world"),
                         "emitter 'directional' has both direction and to_world; keep one.");
    const glm::dmat3 toWorld(properties.transform("to_world"));
    DirectionalEmitter emitter;
    emitter.id = idOf(properties.element());
    emitter.where = properties.element().where;
    const glm::dvec3 direction = toWorld * properties.direction("direction", {0, 0, 1});
    emitter.direction = glm::vec3(glm::normalize(direction));
    // A scale makes it brighter, as in Mitsuba.
    emitter.irradiance = properties.emission("irradiance", {1, 1, 1}) * static_cast<float>(glm::length(direction));
    return emitter;
}

} // namespace quasilux
