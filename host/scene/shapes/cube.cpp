// <shape type="cube">: [-1, 1]³, normals outwards.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

namespace quasilux {

namespace {

/// Mitsuba's texture coordinates of the corner `p` on the face whose normal is the axis -x, +x, -y, +y, -z, +z.
glm::vec2 cubeUv(size_t face, const glm::dvec3& p) {
    const glm::dvec3 a = (p + 1.0) / 2.0, b = (1.0 - p) / 2.0;
    const std::array<glm::dvec2, 6> uv = {{{a.y, a.z}, {a.y, b.z}, {a.z, a.x}, {b.x, b.z}, {b.y, a.x}, {a.y, a.x}}};
    return uv[face];
}

} // namespace

void readCube(Properties& properties, ShapeDescription& shape) {
    std::vector<glm::dvec3> corners; // bit 0: x, bit 1: y, bit 2: z
    corners.reserve(8);
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const std::vector<glm::uvec3> triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},  // -x, +x
                                               {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},  // -y, +y
                                               {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}}; // -z, +z
    std::vector<glm::vec2> uvs;
    uvs.reserve(3 * triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) uvs.push_back(cubeUv(t / 2, corners[triangles[t][i]]));
    properties.accept({"face_normals"}); // its normals are those of its faces
    shape.mesh = flatMesh(corners, triangles, uvs, properties.transform("to_world"), shape.flipNormals, shape.where);
}

} // namespace quasilux
