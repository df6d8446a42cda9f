// The geometry of what a medium fills: its extent, whether it is a plate, and its faces where it is a convex
// polyhedron.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

struct MediumShape {
    double volume = 0;        ///< scene units^3; of the scene's bounds where the medium has none of its own
    double extent = 0;        ///< longest side of its bounding box
    bool isPlate = false;     ///< two parallel faces hold most of its surface
    glm::dvec3 axis{0, 0, 1}; ///< normal of the plate
    double thickness = 0;     ///< of the plate
    bool isUnbounded = false; ///< no shape states it as its interior
    std::vector<shared::MediumPlane> planes; ///< faces of a convex polyhedron with nothing inside; empty otherwise
};

/// Of Scene::media[medium], from the shapes that state it as their interior.
MediumShape findMediumShape(const Scene& scene, unsigned medium);

} // namespace quasilux
