// <shape type="cube">: [-1, 1]³, normals outwards.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

namespace quasilux {

void readCube(Properties& properties, ShapeDescription& shape) {
    std::vector<glm::dvec3> corners; // bit 0: x, bit 1: y, bit 2: z
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    const std::vector<glm::uvec3> triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},  // -x, +x
                                               {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},  // -y, +y
                                               {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}}; // -z, +z
    shape.mesh = flatMesh(corners, triangles, properties.transform("to_world"), shape.flipNormals, shape.where);
}

} // namespace quasilux
