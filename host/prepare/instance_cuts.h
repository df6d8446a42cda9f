// Where instances pass through each other and through the world.
#pragma once

#include "prepare/border_surface.h"
#include "prepare/borders.h"

namespace quasilux {

/// Appends the curves in which the surfaces of instances cut each other and those of the world to borders.segments, in
/// the world. `groups`: by Scene::groups, each in its own space.
void cutInstances(const Scene& scene, const Surface& world, const std::vector<Surface>& groups,
                  SurfaceBorders& borders);

} // namespace quasilux
