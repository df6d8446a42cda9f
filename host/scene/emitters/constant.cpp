// <emitter type="constant">: the same radiance from everywhere outside of the scene.
#include "scene/emitters/emitters.h"

namespace quasilux {

void readConstant(Properties& properties) {
    Surroundings& surroundings = addSurroundings(properties);
    properties.transform("to_world"); // turning the same radiance changes nothing
    surroundings.radiance = properties.emission("radiance", {1, 1, 1});
}

} // namespace quasilux
