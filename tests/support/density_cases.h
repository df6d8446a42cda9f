// Surface points with borders about them, and what is to be seen from there, written down independently of
// host/prepare.
#pragma once

#include "support/density_scene.h"

#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct DensityCase {
    std::string name;
    Scene scene;
    glm::dvec3 position{}, normal{0, 0, 1};
    unsigned primitive = 0;
    /// What ends the line of sight, in the plane of the point.
    std::vector<std::pair<glm::dvec3, glm::dvec3>> obstacles;
    DensityScene::Hidden hidden; ///< photons that no light can reach, such as below a box that stands on the floor
    double kept = 1;             ///< the region holds at least this share of the kernel over what is visible
};

/// Radius 1. Planes, corners, contacts, boxes sunk in, a fin, a round rim, walls behind walls.
std::vector<DensityCase> densityCases();

/// The case turned about an oblique axis, scaled and moved.
DensityCase moved(DensityCase densityCase, const glm::dmat3& rotation, double scale, glm::dvec3 offset);

RegionQuery queryOf(const DensityCase& densityCase, double radius);

} // namespace quasilux
