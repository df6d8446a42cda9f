// What a PLY file says of its vertices or faces besides their places, normals and texture coordinates.
#pragma once

#include "scene/scene.h"
#include "scene/shapes/ply_reader.h"

#include <set>

namespace quasilux {

/// The attributes of one element, by Mitsuba 3's names: colours r, g, b or red, green, blue are "color"; neighbouring
/// properties of one prefix and the endings _x _y _z, _0 _1 _2 or _1 _2 _3, or only the first, are that prefix; with _r
/// _g _b "_color" is added to it. Each begins with `kind`, "vertex_" or "face_". Properties that do not go together so
/// are passed over.
class PlyAttributes {
public:
    PlyAttributes(const PlyElement& element, const std::string& kind);

    /// Adds the values of one row, by property.
    void addRow(const std::vector<std::vector<double>>& row);
    std::vector<MeshAttribute>& attributes() { return attributes_; }

private:
    void add(std::string name, const std::vector<size_t>& properties);

    const PlyElement& element_;
    std::vector<MeshAttribute> attributes_;
    std::set<std::string> names_;              ///< theirs
    std::vector<std::vector<size_t>> sources_; ///< properties that each is made of, one or three
};

} // namespace quasilux
