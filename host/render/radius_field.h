// Density radii by distance from the eye, as photons lie there (kernels/radius_field.clh, docs/method/radius.md).
#pragma once

#include "learn/learning.h"

namespace quasilux {

/// Factors on a radius of `radius` scene units that suits all that the camera sees, so that discs hold as many photons
/// near the eye as far from it; at most `largest`. None where photons lie evenly, or nothing is known of them.
shared::RadiusField radiusField(const LearnedScene& learned, double radius, double largest);

} // namespace quasilux
