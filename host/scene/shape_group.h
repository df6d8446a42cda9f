// Shapes that are there once for all of their instances.
#pragma once

#include "scene/box.h"

#include <glm/glm.hpp>

namespace quasilux {

/// In a space of their own: some of Scene::shapes, that follow each other.
struct ShapeGroup {
    unsigned firstShape = 0, shapeCount = 0;
    Box box; ///< about them
};

/// A place of a group in the scene.
struct Instance {
    unsigned group = 0;       ///< index into Scene::groups
    glm::mat4x3 toWorld{1.f}; ///< from the group's space
};

} // namespace quasilux
