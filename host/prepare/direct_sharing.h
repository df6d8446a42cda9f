// Which scattering shares direct light between emitter sampling and directions of its own.
#pragma once

#include "prepare/device_scene.h"

namespace quasilux {

/// DIRECT_SHARING_* for these emitters and so much area (scene units squared) that scatters. Narrow lobes share always.
/// Lambert lobes and what is near an isotropic phase function must where emitters are sampled by area or all around,
/// which leaves their estimate unbounded. Elsewhere Lambert lobes share where emitters take so much of the area that a
/// diffuse direction often ends on one: there noise falls, while with small lamps the additional rays and evaluations
/// cost more than they bring (docs/method/theory.md, "Direct light"). At an irradiance meter emitter sampling is nearly
/// exact by itself.
unsigned directSharing(const std::vector<shared::Emitter>& emitters, double scatteringArea, bool meter);

} // namespace quasilux
