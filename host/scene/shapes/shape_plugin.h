// Reading of shapes. A new plugin is one file here and one line in shape_table.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"
#include "scene/transform.h"

#include <functional>

namespace quasilux {

/// Reads <shape> with its bsdf and emitter; `sensor` is the one nested in it, not read yet, or nullptr. Throws
/// InputError for anything that is not right with it.
ShapeDescription readShape(const Element& element, LoadContext& context, const Element*& sensor);

/// Whether the plugin is unknown, and forgiven.
bool leavesOutShape(const Element& element, LoadContext& context);

/// A shape and what lies on it.
struct PlacedShape {
    ShapeDescription shape;
    const Element* sensor = nullptr; ///< not read yet
};
/// The shapes that a <shape> directly in the scene stands for: itself, those of an instance or a merge, none for a
/// shapegroup.
std::vector<PlacedShape> readShapes(const Element& element, LoadContext& context);
/// Reads the shapes of a group that no instance places, for their errors.
void checkUnusedGroup(const Element& group, LoadContext& context);

/// What shapes that come from files have in common.
struct MeshFile {
    std::string path; ///< relative to the scene file already resolved
    SourceLocation where;
    bool faceNormals = false;
    bool flipTexCoords = false; ///< v becomes 1 - v
    int64_t index = 0;          ///< of the mesh within the file
    glm::dmat4 toWorld{1.0};
};
MeshFile readMeshFile(Properties& properties);

struct MeshSource;
/// The mesh of that file in world space. `read` is called once for a file that instances place several times.
Mesh placeMeshFile(const MeshFile& file, const std::function<MeshSource()>& read, Properties& properties,
                   const ShapeDescription& shape);

Names shapePluginNames();

void readRectangle(Properties& properties, ShapeDescription& shape);
void readCube(Properties& properties, ShapeDescription& shape);
void readDisk(Properties& properties, ShapeDescription& shape);
void readCylinder(Properties& properties, ShapeDescription& shape);
void readBsplineCurve(Properties& properties, ShapeDescription& shape);
void readLinearCurve(Properties& properties, ShapeDescription& shape);
void readSphere(Properties& properties, ShapeDescription& shape);
void readObj(Properties& properties, ShapeDescription& shape);
void readPly(Properties& properties, ShapeDescription& shape);
void readSerialized(Properties& properties, ShapeDescription& shape);
void readEmbeddedMesh(Properties& properties, ShapeDescription& shape);

} // namespace quasilux
