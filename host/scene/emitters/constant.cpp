// <emitter type="constant">: the same radiance from everywhere outside of the scene.
#include "scene/emitters/emitters.h"

namespace quasilux {

SceneEmitter readConstant(Properties& properties) {
    Surroundings surroundings = newSurroundings(properties);
    properties.transform("to_world"); // turning the same radiance changes nothing
    surroundings.radiance = properties.emission("radiance", {1, 1, 1});
    return surroundings;
}

} // namespace quasilux
