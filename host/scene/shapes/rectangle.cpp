// <shape type="rectangle">: [-1, 1]² in the plane z = 0, normal +z.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

#include <cmath>

namespace quasilux {

void readRectangle(Properties& properties, ShapeDescription& shape) {
    const glm::dmat4 toWorld = properties.transform("to_world");
    properties.accept({"face_normals"}); // its normals are its face's
    const std::vector<glm::dvec3> corners = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const std::vector<glm::vec2> uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    shape.mesh = flatMesh(corners, {{0, 1, 2}, {0, 2, 3}}, uvs, toWorld, shape.flipNormals, shape.where);

    const glm::dvec3 edgeU = transformVector(toWorld, {2, 0, 0}), edgeV = transformVector(toWorld, {0, 2, 0});
    if (std::abs(glm::dot(glm::normalize(edgeU), glm::normalize(edgeV))) >= 1e-5) return;
    const bool reversed = (glm::determinant(glm::dmat3(toWorld)) < 0) != shape.flipNormals;
    const glm::dvec3 cross = glm::normalize(glm::cross(glm::normalize(edgeU), glm::normalize(edgeV)));
    RectangleFrame frame;
    frame.corner = shape.mesh.positions[0];
    frame.edgeU = glm::vec3(edgeU);
    frame.edgeV = glm::vec3(edgeV);
    frame.normal = glm::vec3(reversed ? -cross : cross);
    shape.rectangle = frame;
}

} // namespace quasilux
