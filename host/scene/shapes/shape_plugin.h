// Reading of shapes. A new plugin is one file here and one line in shape_table.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"
#include "scene/transform.h"

namespace quasilux {

/// Reads <shape> with its bsdf and emitter; `sensor` is the one nested in it, not read yet, or nullptr. Throws
/// InputError for anything that is not right with it.
ShapeDescription readShape(const Element& element, LoadContext& context, const Element*& sensor);

/// What shapes that come from files have in common. `flipsTexCoords` is the default of flip_tex_coords.
struct MeshFile {
    std::string path; ///< relative to the scene file already resolved
    SourceLocation where;
    bool faceNormals = false;
    bool flipTexCoords = false; ///< v becomes 1 - v
    glm::dmat4 toWorld{1.0};
};
MeshFile readMeshFile(Properties& properties, bool flipsTexCoords);

void readRectangle(Properties& properties, ShapeDescription& shape);
void readCube(Properties& properties, ShapeDescription& shape);
void readDisk(Properties& properties, ShapeDescription& shape);
void readCylinder(Properties& properties, ShapeDescription& shape);
void readSphere(Properties& properties, ShapeDescription& shape);
void readObj(Properties& properties, ShapeDescription& shape);
void readPly(Properties& properties, ShapeDescription& shape);

} // namespace quasilux
