// Where a scene's own origin lies. Single precision knows a place 1e5 units from the origin to 0.008 units only, so a
// scene far from it is loaded relative to its centre: coordinates are subtracted in double precision before they are
// rounded.
#pragma once

#include "scene/scene.h"

namespace quasilux {

/// About shapes, in their own coordinates, and about an instance in the scene's.
Box boxOf(std::span<const ShapeDescription> shapes);
inline Box boxOf(const ShapeDescription& shape) { return boxOf(std::span(&shape, 1)); }
Box boxOf(const Scene& scene, const Instance& instance);
/// About all of them, in the scene's coordinates.
Box boxOf(const Scene& scene);

/// The centre of `box`, which counts from `origin`, if it is further from 0 than four times the box's size; else 0.
glm::dvec3 farCenter(const Box& box, const glm::dvec3& origin = glm::dvec3(0));

/// Where Scene::origin should be: the centre of the bounding box of all shapes, in coordinates of the file, if it is
/// further than four times the box's size from the file's origin; else that origin, so that most scenes are loaded as
/// they are written.
glm::dvec3 chooseOrigin(const Scene& scene);

} // namespace quasilux
