// Procedural scenes of three sizes, each with a camera and a lamp.
#pragma once

#include "prepare/bvh.h"

namespace quasilux {

/// Box of five walls at -1 and 1, open at z = 1, with two boxes turned about y and a lamp below the ceiling: 36
/// triangles.
std::vector<BvhPrimitive> cornellBoxPrimitives();

/// Sphere of radius about 1 with bumps, 2 * rings * segments triangles (less the two degenerate rows at the poles).
std::vector<BvhPrimitive> bumpySpherePrimitives(unsigned rings, unsigned segments);

/// Hills with trees: trunks, and crowns of single leaves turned anyhow. About `triangles` of them, from 20,000 on.
std::vector<BvhPrimitive> forestPrimitives(size_t triangles);

struct MicroScene {
    std::string name;
    std::vector<BvhPrimitive> triangles;
    glm::vec3 eye{}, target{};                        ///< the camera sees 60 degrees across
    glm::vec3 lampCorner{}, lampEdgeU{}, lampEdgeV{}; ///< rectangle to which shadow rays go
};

/// The Cornell box, the sphere in a closed box (`rings` rings and segments), the forest.
MicroScene cornellScene();
MicroScene sphereScene(unsigned rings);
MicroScene forestScene(size_t triangles);

} // namespace quasilux
