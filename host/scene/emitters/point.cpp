// <emitter type="point">: the same intensity in all directions from one point.
#include "scene/emitters/emitters.h"
#include "scene/media/medium_plugin.h"
#include "scene/transform.h"

namespace quasilux {

PointEmitter darkPointAt(const glm::dvec3& position, Properties& properties) {
    PointEmitter emitter;
    emitter.id = idOf(properties.element());
    emitter.where = properties.element().where;
    emitter.position = toSingle(position, emitter.where);
    if (const Element* medium = properties.object("medium")) emitter.medium = useMedium(*medium, properties.context());
    return emitter;
}

PointEmitter pointEmitterAt(const glm::dvec3& position, Properties& properties) {
    PointEmitter emitter = darkPointAt(position, properties);
    emitter.intensity = properties.emission("intensity", {1, 1, 1});
    return emitter;
}

SceneEmitter readPoint(Properties& properties) {
    if (properties.has("position") && properties.has("to_world"))
        throw InputError(properties.where("to_world"), "emitter 'point' has both position and to_world; keep one.");
    const glm::dvec3 position =
        transformPoint(properties.transform("to_world"), properties.vector("position", glm::dvec3(0)));
    return pointEmitterAt(position, properties);
}

} // namespace quasilux
