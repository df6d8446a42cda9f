// Every kind of bad mesh file is refused at its line, or at the number of its element where it is binary.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::SceneFiles;
using test::sceneWith;

const char* const plyHeader =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

struct BadMesh {
    const char* name;
    const char* file;
    std::string content;
    const char* expected;
};
void PrintTo(const BadMesh& bad, std::ostream* out) { *out << bad.content; }

class BadMeshFile : public testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshFile, IsRefusedAtItsLine) {
    SceneFiles files;
    const std::string file = GetParam().file;
    files.write(file, GetParam().content);
    const std::string shape =
        "<shape type=\"" + file.substr(5) + "\"><string name=\"filename\" value=\"" + file + "\"/></shape>";
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith(shape))), testing::HasSubstr(GetParam().expected));
}

const std::string binaryHeader =
    "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
    "element face 2\nproperty list uchar uchar vertex_indices\nend_header\n";

const BadMesh badMeshes[] = {
    {"ObjEmpty", "mesh.obj", "# nothing\n", "mesh.obj: the mesh has no faces"},
    {"ObjOnlyVertices", "mesh.obj", "v 0 0 0\n", "mesh.obj: the mesh has no faces"},
    {"ObjIndexTooLarge", "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
     "mesh.obj:4: face: vertex index 4 does not exist; the file has 3"},
    {"ObjIndexTooFarBack", "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n",
     "mesh.obj:4: face: vertex index -4 does not exist"},
    {"ObjIndexZero", "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
     "mesh.obj:4: face: vertex index 0 does not exist"},
    {"ObjNormalIndex", "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n",
     "mesh.obj:4: face: normal index 1 does not exist; the file has 0"},
    {"ObjIndexNotANumber", "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n",
     "mesh.obj:4: face: vertex index: 'x' is not an integer"},
    {"ObjTwoCorners", "mesh.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "mesh.obj: the mesh has no faces"},
    {"ObjShortVertex", "mesh.obj", "v 0 0\n", "mesh.obj:1: a vertex with 2 numbers"},
    {"ObjNan", "mesh.obj", "v 0 0 nan\n", "mesh.obj:1: vertex: 'nan' is not finite"},
    {"ObjGarbage", "mesh.obj", "hello world\n", "mesh.obj:1: unknown line 'hello world'"},
    {"CurveTooShort", "mesh.bsplinecurve", "0 0 0 1\n0 0 1 1\n0 0 2 1\n0 0 3 1\n\n0 0 0 1\n0 0 1 1\n0 0 2 1\n",
     "mesh.bsplinecurve:8: a curve of 3 control points ends here; expected at least 4"},
    {"CurveOfOnePoint", "mesh.linearcurve", "0 0 0 1\n\n0 0 1 1\n",
     "mesh.linearcurve:2: a curve of 1 control points ends here"},
    {"CurveWithoutRadius", "mesh.linearcurve", "0 0 0 1\n0 0 1\n",
     "mesh.linearcurve:2: a control point of 3 numbers; expected four"},
    {"CurveTooLong", "mesh.linearcurve", "0 0 0 1 1\n", "mesh.linearcurve:1: a control point of 5 numbers"},
    {"CurveNegative", "mesh.linearcurve", "0 0 0 1\n0 0 1 -1\n",
     "mesh.linearcurve:2: a radius of -1; it must not be negative"},
    {"CurveNoNumber", "mesh.linearcurve", "0 0 0 1\n0 0 1 1\n\n\n0 0 x 1\n",
     "mesh.linearcurve:5: control point: 'x' is not"},
    {"CurveEmpty", "mesh.bsplinecurve", "\n \n", "mesh.bsplinecurve: the file has no control points"},
    {"CurveAtAPoint", "mesh.linearcurve", "1 0 0 1\n1 0 0 2\n",
     "scene.xml:4:27: a curve's control points are all the same"},
    {"SplineAtAPoint", "mesh.bsplinecurve", "1 0 0 1\n1 0 0 2\n1 0 0 1\n1 0 0 1\n",
     "scene.xml:4:28: a curve's control points are all the same"},
    {"CurveWithoutArea", "mesh.linearcurve", "1 0 0 0\n2 0 0 0\n", "scene.xml:4:27: the curves have no area"},
    {"PlyMagic", "mesh.ply", "plx\n", "mesh.ply:1: this is not a PLY file"},
    {"PlyFormat", "mesh.ply", "ply\nformat asci 1.0\n", "mesh.ply:2: unknown format 'asci'. Did you mean 'ascii'?"},
    {"PlyNoFormat", "mesh.ply", "ply\nend_header\n", "mesh.ply:2: the header has no line 'format'"},
    {"PlyHeaderEnd", "mesh.ply", "ply\nformat ascii 1.0\n", "mesh.ply:2: the header does not end"},
    {"PlyHeaderLine", "mesh.ply", "ply\nformat ascii 1.0\nelemnt vertex 3\n",
     "mesh.ply:3: malformed header line 'elemnt vertex 3'"},
    {"PlyType", "mesh.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty flt x\n",
     "mesh.ply:4: unknown type 'flt'"},
    {"PlyIndex", "mesh.ply", std::string(plyHeader) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
     "mesh.ply:13: face 0: vertex index 3 does not exist; there are 3 vertices"},
    {"PlyTwoCorners", "mesh.ply", std::string(plyHeader) + "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
     "mesh.ply:13: face 0: a face with 2 corners"},
    {"PlyNotANumber", "mesh.ply", std::string(plyHeader) + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n",
     "mesh.ply:11: vertex 1: 'x' is not a number"},
    {"PlyTooShort", "mesh.ply", std::string(plyHeader) + "0 0 0\n1 0 0\n", "vertex 2: the file ends too early"},
    {"PlyTooLong", "mesh.ply", std::string(plyHeader) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n9\n",
     "mesh.ply: data follow the last element"},
    {"PlyNoFaces", "mesh.ply",
     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 "
     "0\n",
     "mesh.ply: the mesh has no faces"},
    {"PlyBinaryIndex", "mesh.ply", binaryHeader + std::string("\1\1\1\3\0\0\0\3\0\0\5", 11),
     "mesh.ply: face 1: vertex index 5 does not exist"},
    {"PlyBinaryTooShort", "mesh.ply", binaryHeader + std::string("\1\1\1\3\0\0\0\3\0", 9),
     "mesh.ply: face 1: a list of 3 values is longer than the file"},
    {"PlyHugeCount", "mesh.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty "
     "float z\nend_header\n",
     "mesh.ply: vertex 0: the file ends too early"},
};
INSTANTIATE_TEST_SUITE_P(Meshes, BadMeshFile, testing::ValuesIn(badMeshes),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(ZeroAreaEmitter, IsRefusedForADegenerateMesh) {
    SceneFiles files;
    files.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    const std::string shape = "<shape type=\"obj\" id=\"line\"><string name=\"filename\" value=\"line.obj\"/><emitter "
                              "type=\"area\"/></shape>";
    EXPECT_THAT(errorOf(files.write("scene.xml", sceneWith(shape))),
                testing::HasSubstr("scene.xml:4:1: shape 'line' emits but has no area"));
}

} // namespace
} // namespace quasilux
