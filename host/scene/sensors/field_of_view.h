// The opening of cameras and projectors.
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Full horizontal angle, radians, by `fov` and `fov_axis` or `focal_length`; `aspect` is width / height of the
/// picture.
double readFieldOfView(Properties& properties, double aspect);

} // namespace quasilux
