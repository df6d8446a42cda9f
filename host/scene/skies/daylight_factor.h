// What a daylight factor is a share of: the illuminance of free ground by the sky without the sun (CIE S 017,
// 17-29-121).
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

namespace quasilux {

struct SkyAlone {
    glm::dvec3 groundIrradiance{}; ///< R, G, B: of a plane that faces the zenith, nothing in its way
    size_t leftOut = 0;            ///< lamps and suns
};

/// Leaves the surroundings as the only light of the scene. Throws InputError where there are none, or where the sun is
/// a part of them.
SkyAlone keepSkyAlone(Scene& scene);

} // namespace quasilux
