// <shape type="mesh">: a mesh that the scene holds itself, such as one of a glTF file.
#include "scene/embedded_parts.h"
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

#include <fmt/format.h>

namespace quasilux {

void readEmbeddedMesh(Properties& properties, ShapeDescription& shape) {
    const std::string name = properties.string("name", "");
    const EmbeddedParts& parts = *properties.context().embedded;
    const auto found = parts.meshes.find(name);
    if (found == parts.meshes.end())
        throw InputError(properties.where("name"), fmt::format("the scene holds no mesh '{}'.", name));
    const bool faceNormals = properties.boolean("face_normals", false);
    shape.mesh = fileMesh(*found->second, properties.transform("to_world"), shape.flipNormals, faceNormals, shape.where,
                          properties.context().placement);
}

} // namespace quasilux
