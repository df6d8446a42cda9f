// <shape type="ply">: Stanford PLY, ascii or binary of either byte order. Polygons are fanned.
#include "scene/shapes/mesh_builder.h"
#include "scene/shapes/ply_attributes.h"
#include "scene/shapes/ply_reader.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/xml/xml_document.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Index of a property with one of `names`, or -1.
int findProperty(const PlyElement& element, const Names& names) {
    for (size_t i = 0; i < element.properties.size(); ++i)
        if (std::find(names.begin(), names.end(), element.properties[i].name) != names.end())
            return static_cast<int>(i);
    return -1;
}

/// Of u and v by whichever names both have; -1 where they have none.
std::pair<int, int> findTextureCoordinates(const PlyElement& element) {
    for (const auto& [u, v] : {std::pair("u", "v"), std::pair("texture_u", "texture_v"), std::pair("s", "t")})
        if (const std::pair found(findProperty(element, {u}), findProperty(element, {v}));
            found.first >= 0 && found.second >= 0)
            return found;
    return {-1, -1};
}

class PlyMeshReader {
public:
    PlyMeshReader(PlyReader& reader, bool flipTexCoords) : reader_(reader), flipTexCoords_(flipTexCoords) {}

    MeshSource read() {
        for (const PlyElement& element : reader_.elements()) {
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face")
                readFaces(element);
            else
                skip(element);
        }
        reader_.expectEnd();
        if (mesh_.triangles.empty())
            reader_.failFile("the mesh has no faces; expected an element 'face' with vertex_indices.");
        return std::move(mesh_);
    }

private:
    void readVertices(const PlyElement& element) {
        const int x = findProperty(element, {"x"}), y = findProperty(element, {"y"}), z = findProperty(element, {"z"});
        const int nx = findProperty(element, {"nx"}), ny = findProperty(element, {"ny"}),
                  nz = findProperty(element, {"nz"});
        const auto [u, v] = findTextureCoordinates(element);
        if (x < 0 || y < 0 || z < 0) reader_.failFile("the vertices have no x, y, z.");
        const bool hasNormals = nx >= 0 && ny >= 0 && nz >= 0;
        PlyAttributes attributes(element, "vertex_");
        for (uint64_t i = 0; i < element.count; ++i) {
            readRow(element, i);
            const auto vector = [&](int a, int b, int c) { return glm::dvec3(scalar(a), scalar(b), scalar(c)); };
            mesh_.positions.push_back(vector(x, y, z));
            if (hasNormals) mesh_.normals.push_back(vector(nx, ny, nz));
            if (u >= 0 && v >= 0) mesh_.uvs.emplace_back(scalar(u), flipTexCoords_ ? 1 - scalar(v) : scalar(v));
            attributes.addRow(row_);
        }
        take(attributes);
    }

    void readFaces(const PlyElement& element) {
        const int indices = findProperty(element, {"vertex_indices", "vertex_index"});
        if (indices < 0 || !element.properties[static_cast<size_t>(indices)].isList)
            reader_.failFile("the faces have no list vertex_indices.");
        PlyAttributes attributes(element, "face_");
        for (uint64_t i = 0; i < element.count; ++i) {
            readRow(element, i);
            const std::vector<double>& corners = row_[static_cast<size_t>(indices)];
            if (corners.size() < 3)
                reader_.failRow(fmt::format("a face with {} corners; expected at least three.", corners.size()));
            for (size_t c = 2; c < corners.size(); ++c) {
                mesh_.triangles.push_back({makeCorner(corners[0]), makeCorner(corners[c - 1]), makeCorner(corners[c])});
                attributes.addRow(row_);
            }
        }
        take(attributes);
    }

    void take(PlyAttributes& attributes) {
        for (MeshAttribute& attribute : attributes.attributes()) mesh_.attributes.push_back(std::move(attribute));
    }

    void skip(const PlyElement& element) {
        for (uint64_t i = 0; i < element.count; ++i) readRow(element, i);
    }

    MeshSource::Corner makeCorner(double index) const {
        if (!(index >= 0 && index < static_cast<double>(mesh_.positions.size())) || index != std::floor(index))
            reader_.failRow(
                fmt::format("vertex index {} does not exist; there are {} vertices.", index, mesh_.positions.size()));
        MeshSource::Corner corner;
        corner.position = static_cast<unsigned>(index);
        corner.vertex = corner.position;
        if (!mesh_.normals.empty()) corner.normal = corner.position;
        if (!mesh_.uvs.empty()) corner.uv = corner.position;
        return corner;
    }

    void readRow(const PlyElement& element, uint64_t number) {
        reader_.beginRow(element, number);
        row_.resize(element.properties.size());
        for (size_t i = 0; i < element.properties.size(); ++i) reader_.readProperty(element.properties[i], row_[i]);
    }

    double scalar(int property) const {
        const std::vector<double>& values = row_[static_cast<size_t>(property)];
        if (values.size() != 1 || !std::isfinite(values[0])) reader_.failRow("a vertex is not made of finite numbers.");
        return values[0];
    }

    PlyReader& reader_;
    bool flipTexCoords_;
    MeshSource mesh_;
    std::vector<std::vector<double>> row_; ///< values by property
};

} // namespace

void readPly(Properties& properties, ShapeDescription& shape) {
    MeshFile file = readMeshFile(properties);
    file.flipTexCoords = properties.boolean("flip_tex_coords", false);
    const auto read = [&] {
        PlyReader reader(file.path, readTextFile(file.path, file.where, "mesh"));
        return PlyMeshReader(reader, file.flipTexCoords).read();
    };
    shape.mesh = placeMeshFile(file, read, properties, shape);
}

} // namespace quasilux
