// Smooth patches of the surfaces and the straight segments that border them, for the density estimate (docs/density.md).
#pragma once

#include "scene/scene.h"

#include <vector>

namespace quasilux {

struct SurfaceBorders {
    std::vector<unsigned> patchOfPrimitive;       ///< by primitive index (shapes in order, triangles in order; a sphere is one)
    unsigned patchCount = 0;
    std::vector<shared::BorderSegment> segments;  ///< free edges, creases, and curves where other surfaces cut or touch
    struct Grid {                                 ///< uniform grid over the segments: which may lie within `reach` of a cell
        glm::vec3 lower{};
        float cellSize = 1;
        glm::uvec3 cells{1};
        std::vector<unsigned> cellStart;  ///< cells.x*cells.y*cells.z + 1 offsets into `items`
        std::vector<unsigned> items;      ///< segment indices
    };
};

/// Finds them. Edges flatter than `creaseAngle` (radians) join a patch; so do coincident vertices within rounding.
SurfaceBorders findBorders(const Scene& scene, double creaseAngle = 0.35);

/// Grid for points that look no further than `reach`: a point's own cell lists every segment within `reach` of it.
SurfaceBorders::Grid indexBorders(const SurfaceBorders& borders, float reach);

} // namespace quasilux
