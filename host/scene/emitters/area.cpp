// <emitter type="area">: a shape that emits the same radiance in all directions on the side of its normal.
#include "scene/emitters/emitters.h"

namespace quasilux {

AreaEmitter readArea(Properties& properties) {
    AreaEmitter emitter;
    emitter.radiance = properties.emission("radiance", {1, 1, 1});
    emitter.where = properties.element().where;
    return emitter;
}

} // namespace quasilux
