// Control points of <shape type="bsplinecurve"> and <shape type="linearcurve">.
#pragma once

#include "scene/properties.h"

#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

struct CurvePoint {
    glm::dvec3 position{}; ///< under the curve's own to_world
    double radius = 0;     ///< which leaves it, as in Mitsuba; instances scale the tube as a whole
};
using Curve = std::vector<CurvePoint>;

/// Those of the file `filename` under the curve's own `to_world`, before an instance places them: lines "x y z radius",
/// blank lines between curves of at least `fewest` points. Throws InputError at its line for a bad file.
std::vector<Curve> readCurves(Properties& properties, size_t fewest);

} // namespace quasilux
