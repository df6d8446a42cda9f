// Control points of <shape type="bsplinecurve"> and <shape type="linearcurve">.
#pragma once

#include "scene/properties.h"

#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

struct CurvePoint {
    glm::dvec3 position{}; ///< in world space
    double radius = 0;     ///< there, too: transforms leave it, as in Mitsuba
};
using Curve = std::vector<CurvePoint>;

/// Those of the file `filename` under `to_world`: lines "x y z radius", blank lines between curves of at least `fewest`
/// points. Throws InputError at its line for a bad file.
std::vector<Curve> readCurves(Properties& properties, size_t fewest);

} // namespace quasilux
