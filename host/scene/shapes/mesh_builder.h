// From the vertices of a file or a built-in shape to a Mesh in world space.
#pragma once

#include "scene/scene.h"
#include "scene/transform.h"

#include <array>

namespace quasilux {

/// Sectors that round shapes of radius 1 are cut into, and the radius of their corners: the polygon has the circle's
/// area.
inline constexpr unsigned roundSectors = 256;
double roundRadius(unsigned sectors);

/// A mesh in its own space.
struct MeshSource {
    struct Corner {
        unsigned position = 0;
        unsigned normal = QL_NONE; ///< QL_NONE: the file gives none
        unsigned uv = QL_NONE;     ///< likewise
        uint64_t vertex = 0;       ///< corners of the same vertex share a computed normal
    };
    std::vector<glm::dvec3> positions, normals;
    std::vector<glm::dvec2> uvs;
    std::vector<std::array<Corner, 3>> triangles;
    std::vector<MeshAttribute> attributes; ///< by position or by triangle
};

/// Built-in shapes with flat faces: `triangles` are counter-clockwise seen from the side of the normal, and stay so
/// under mirroring (normals go by the inverse transpose). `uvs` are texture coordinates, 3 per triangle.
Mesh flatMesh(const std::vector<glm::dvec3>& positions, const std::vector<glm::uvec3>& triangles,
              const std::vector<glm::vec2>& uvs, const glm::dmat4& toWorld, bool flipNormals,
              const SourceLocation& where);

/// Meshes of files, with the corner normals of Mitsuba 3: those of the file; where it has none at all, means over the
/// faces at a vertex, weighted by angle; flat where `faceNormals`. Flat faces and computed normals follow the winding
/// after the transform; normals of the file go by the inverse transpose and the winding is made to agree with them.
/// Texture coordinates are kept where some corner has them. `placement`: the part of `toWorld` that is an instance's,
/// under which all normals go by the inverse transpose.
Mesh fileMesh(const MeshSource& source, const glm::dmat4& toWorld, bool flipNormals, bool faceNormals,
              const SourceLocation& where, const std::optional<glm::dmat4>& placement = {});

} // namespace quasilux
