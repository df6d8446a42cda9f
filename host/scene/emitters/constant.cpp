// <emitter type="constant">: the same radiance from everywhere outside of the scene.
#include "scene/emitters/emitters.h"

#include <fmt/format.h>

namespace quasilux {

void readConstant(Properties& properties) {
    auto& surroundings = properties.context().scene.surroundings;
    const Element& element = properties.element();
    if (surroundings)
        throw InputError(element.where, fmt::format("a second emitter 'constant', after line {}; keep one.",
                                                    surroundings->where.line));
    properties.transform("to_world"); // turning the same radiance changes nothing
    surroundings.emplace();
    surroundings->id = idOf(element);
    surroundings->where = element.where;
    surroundings->radiance = properties.emission("radiance", {1, 1, 1});
}

} // namespace quasilux
