// Parameters of shapes that come from files.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/shape_plugin.h"

#include <fmt/format.h>

namespace quasilux {

MeshFile readMeshFile(Properties& properties) {
    const std::string name = properties.string("filename", "");
    if (name.empty())
        throw InputError(properties.where("filename"),
                         fmt::format("{} needs <string name=\"filename\" value=\"…\"/>.", properties.describe()));
    MeshFile file;
    file.where = properties.where("filename");
    file.path = properties.context().files.resolve(name, file.where);
    file.faceNormals = properties.boolean("face_normals", false);
    file.toWorld = properties.transform("to_world");
    return file;
}

Mesh placeMeshFile(const MeshFile& file, const std::function<MeshSource()>& read, Properties& properties,
                   const ShapeDescription& shape) {
    const auto place = [&](const MeshSource& source) {
        return fileMesh(source, file.toWorld, shape.flipNormals, file.faceNormals, shape.where,
                        properties.context().placement);
    };
    if (!properties.context().placement) return place(read());
    std::shared_ptr<const MeshSource>& known =
        properties.context().instancedMeshes[fmt::format("{} {} {}", file.index, file.flipTexCoords, file.path)];
    if (!known) known = std::make_shared<const MeshSource>(read());
    return place(*known);
}

} // namespace quasilux
