// The scene's surfaces as the search for borders sees them: welded vertices, triangles with normals, spheres.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace quasilux {

/// Lengths below this share of the largest coordinate about them are rounding: 4 to 8 units in the last place of a
/// float.
constexpr double borderRounding = 4 * 1.1920928955078125e-07;

struct SurfaceTriangle {
    enum class Kind : uint8_t {
        regular,
        degenerate, ///< no area beyond rounding
        duplicate   ///< has the corners of an earlier regular triangle, in any order
    };
    glm::uvec3 corner{}; ///< into Surface::vertices
    unsigned primitive = 0;
    Kind kind = Kind::regular;
    unsigned original = 0;   ///< duplicate: index of the triangle that it repeats
    uint8_t borderEdges = 0; ///< bit i: the edge from corner i to corner i + 1 is a border
    uint8_t ownedEdges = 0;  ///< bit i: of the triangles that share this edge, this one speaks for it
    uint8_t storing = 0;     ///< storingOf() its shape
    glm::dvec3 normal{};     ///< unit; zero where degenerate
    double area = 0;
    double rounding = 0; ///< borderRounding times the largest coordinate of its corners
};

struct SurfaceSphere {
    glm::dvec3 center{};
    double radius = 0;
    unsigned primitive = 0;
    double rounding = 0;
};

struct Surface {
    std::vector<glm::dvec3> vertices;
    std::vector<SurfaceTriangle> triangles;
    std::vector<SurfaceSphere> spheres;
    unsigned primitiveCount = 0; ///< of the scene, those of `null` shapes included
};

/// Whether light passes this shape untouched: it holds no photons and borders nothing.
bool isInvisible(const Scene& scene, const ShapeDescription& shape);

/// What decides which photons lie on a shape, and how much of their flux: where it differs, what one half of a disc
/// holds says nothing of the other. By side, whether a lobe is genuinely diffuse by its width, narrow, or none takes
/// photons at all, and whether a texture bends the normals.
uint8_t storingOf(const Scene& scene, const ShapeDescription& shape);

unsigned primitiveCount(const ShapeDescription& shape);

/// Measures a triangle with these corners: what follows from them.
void measureTriangle(SurfaceTriangle& triangle, const std::vector<glm::dvec3>& vertices);
SurfaceSphere makeSurfaceSphere(const Sphere& sphere, unsigned primitive);

/// Triangles and spheres of those of the scene's shapes that are visible, with vertices that coincide within rounding
/// made one.
Surface collectSurface(const Scene& scene, std::span<const ShapeDescription> shapes);

} // namespace quasilux
