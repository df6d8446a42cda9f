// Parameters of shapes that come from files.
#include "scene/shapes/shape_plugin.h"

#include <fmt/format.h>

namespace quasilux {

MeshFile readMeshFile(Properties& properties, bool flipsTexCoords) {
    const std::string name = properties.string("filename", "");
    if (name.empty())
        throw InputError(properties.where("filename"),
                         fmt::format("{} needs <string name=\"filename\" value=\"…\"/>.", properties.describe()));
    MeshFile file;
    file.where = properties.where("filename");
    file.path = properties.context().files.resolve(name, file.where);
    file.faceNormals = properties.boolean("face_normals", false);
    file.toWorld = properties.transform("to_world");
    file.flipTexCoords = properties.boolean("flip_tex_coords", flipsTexCoords);
    return file;
}

} // namespace quasilux
