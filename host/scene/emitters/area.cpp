// <emitter type="area">: a shape that emits the same radiance in all directions on the side of its normal; and
// <emitter type="directionalarea">: one that emits along its normal only.
#include "scene/emitters/emitters.h"
#include "scene/textures/texture_plugin.h"

namespace quasilux {

AreaEmitter readArea(Properties& properties) {
    AreaEmitter emitter;
    const EmissionColor radiance = readEmission(properties, "radiance", {1, 1, 1}, true);
    emitter.radiance = radiance.scale;
    emitter.texture = radiance.texture;
    emitter.where = properties.element().where;
    return emitter;
}

AreaEmitter readDirectionalArea(Properties& properties) {
    AreaEmitter emitter = readArea(properties);
    emitter.alongNormal = true;
    return emitter;
}

} // namespace quasilux
