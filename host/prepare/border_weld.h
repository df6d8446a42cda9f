// Makes vertices that coincide within float rounding one.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

struct WeldedVertices {
    std::vector<glm::dvec3> positions; ///< of the vertices that remain
    std::vector<unsigned> vertexOf;    ///< by index into the positions given
};

/// Joins positions that are equal, or differ by less than the rounding of the triangles about them (borderRounding
/// times their largest coordinate), but never over more than a tenth of an edge. Positions must be finite.
WeldedVertices weldVertices(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles);

} // namespace quasilux
