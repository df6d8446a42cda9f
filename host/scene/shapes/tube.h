// Tubes about curves, as meshes: rings of corners about an axis, joined one to the next.
#pragma once

#include "scene/shapes/mesh_builder.h"

namespace quasilux {

/// Sectors of a tube. Its polygons have the circle's circumference, so that a tube looks as broad as it is, on an
/// average over the sides that it is seen from: corners lie 0.16 % of the radius beyond the circle, the middles of
/// sides 0.32 % within it.
inline constexpr unsigned tubeSectors = 32;
/// How far a chord may lie from the curve that it stands for, as a share of the radius.
inline constexpr double tubeTolerance = 1 / 300.0;

struct Ring {
    glm::dvec3 centre{}, axis{0, 0, 1}; ///< the latter unit, forwards
    double radius = 0;
    /// The surface's normal is (along - radius n·turn) n - slope axis, where n is the unit vector from the centre to
    /// the corner: `along`, `turn` and `slope` are the derivatives by one parameter of the place along the axis, of the
    /// axis, and of the radius.
    double along = 1, slope = 0;
    glm::dvec3 turn{0};
};

/// Adds the tube through these rings, two or more. Its ends are open.
void appendTube(const std::vector<Ring>& rings, MeshSource& mesh);
/// Tubes under their own to_world as the mesh of `shape`, where `placement` puts it. Throws InputError at `file` where
/// they have no area.
Mesh tubeMesh(const MeshSource& tubes, const glm::dmat4& placement, const ShapeDescription& shape,
              const SourceLocation& file);

} // namespace quasilux
