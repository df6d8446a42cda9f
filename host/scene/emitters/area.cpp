// <emitter type="area">: a shape that emits the same radiance in all directions on the side of its normal.
#include "scene/emitters/emitters.h"
#include "scene/textures/texture_plugin.h"

namespace quasilux {

AreaEmitter readArea(Properties& properties) {
    AreaEmitter emitter;
    const EmissionColor radiance = readEmission(properties, "radiance", {1, 1, 1});
    emitter.radiance = radiance.scale;
    emitter.texture = radiance.texture;
    emitter.where = properties.element().where;
    return emitter;
}

} // namespace quasilux
