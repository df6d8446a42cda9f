// Shapes in world space: built-in ones, OBJ and PLY files; winding and normals under mirroring and flips.
#include "scene/scene.h"

#include "support/scene_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <numbers>

namespace quasilux {
namespace {

using test::expectNear;
using test::loadShape;
using test::placed;
using test::SceneFiles;
using test::sceneWith;

const std::string dataFolder = std::string(QUASILUX_SOURCE_DIR) + "/tests/data/";

glm::vec3 faceNormal(const Mesh& mesh, size_t triangle) {
    const glm::uvec3 t = mesh.triangles.at(triangle);
    const glm::vec3 a = mesh.positions.at(t.x);
    return glm::normalize(glm::cross(mesh.positions.at(t.y) - a, mesh.positions.at(t.z) - a));
}

TEST(Rectangle, FrameAndWindingFollowTheInverseTransposeNormal) {
    const struct {
        const char* operations;
        bool flip;
        glm::vec3 normal;
    } cases[] = {
        {R"(<scale value="1"/>)", false, {0, 0, 1}}, {R"(<scale value="1"/>)", true, {0, 0, -1}},
        {R"(<scale z="-1"/>)", false, {0, 0, -1}},   {R"(<scale x="-1"/>)", false, {0, 0, 1}},
        {R"(<scale x="-1"/>)", true, {0, 0, -1}},    {R"(<rotate x="1" angle="-90"/>)", false, {0, 1, 0}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(std::string(c.operations) + (c.flip ? " flipped" : ""));
        const std::string flip =
            std::string("<boolean name=\"flip_normals\" value=\"") + (c.flip ? "true" : "false") + "\"/>";
        const ShapeDescription shape = loadShape(placed("rectangle", c.operations, flip));
        ASSERT_TRUE(shape.rectangle);
        expectNear(shape.rectangle->normal, c.normal);
        for (size_t t = 0; t < 2; ++t) expectNear(faceNormal(shape.mesh, t), c.normal);
        EXPECT_NEAR(glm::length(glm::cross(shape.rectangle->edgeU, shape.rectangle->edgeV)), 4, 1e-5);
        EXPECT_TRUE(shape.mesh.cornerNormals.empty());
    }
}

TEST(Rectangle, ShearedOneHasNoFrame) {
    EXPECT_FALSE(loadShape(placed("rectangle", R"(<matrix value="1 0.5 0  0 1 0  0 0 1"/>)")).rectangle);
}

TEST(Cube, FacesLookOutwardsAlsoWhenMirroredAndInwardsWhenFlipped) {
    for (const bool flip : {false, true}) {
        for (const char* operations : {"<scale x=\"2\"/>", "<scale x=\"-2\"/>"}) {
            const std::string parameter =
                std::string("<boolean name=\"flip_normals\" value=\"") + (flip ? "true" : "false") + "\"/>";
            const ShapeDescription shape = loadShape(placed("cube", operations, parameter));
            ASSERT_EQ(shape.mesh.triangles.size(), 12u);
            double volume = 0; // signed: positive where the faces look outwards
            for (size_t t = 0; t < 12; ++t) {
                const glm::uvec3 i = shape.mesh.triangles[t];
                const auto& p = shape.mesh.positions;
                const glm::vec3 center = (p[i.x] + p[i.y] + p[i.z]) / 3.0f;
                EXPECT_GT(glm::dot(faceNormal(shape.mesh, t), center) * (flip ? -1 : 1), 0);
                volume += glm::dot(p[i.x], glm::cross(p[i.y], p[i.z])) / 6;
            }
            EXPECT_NEAR(volume, flip ? -16 : 16, 1e-5);
        }
    }
}

double areaOfMesh(const Mesh& mesh) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[t.x];
        area += glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a)) / 2;
    }
    return area;
}

// A polygon of the circle's area; texture coordinates are radius and angle, as Mitsuba's.
TEST(Disk, HasTheAreaOfItsCircleAndLooksAlongZ) {
    for (const bool flip : {false, true}) {
        const std::string parameter =
            std::string("<boolean name=\"flip_normals\" value=\"") + (flip ? "true" : "false") + "\"/>";
        const Mesh mesh = loadShape(placed("disk", "<scale value=\"2\"/><translate z=\"3\"/>", parameter)).mesh;
        EXPECT_NEAR(areaOfMesh(mesh), 4 * std::numbers::pi, 1e-4);
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            expectNear(faceNormal(mesh, t), {0, 0, flip ? -1 : 1});
            const glm::uvec3 corners = mesh.triangles[t];
            const unsigned index[] = {corners.x, corners.y, corners.z};
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3 p = mesh.positions[index[k]];
                const glm::vec2 uv = mesh.cornerUvs[3 * t + k];
                EXPECT_NEAR(uv.x, std::hypot(p.x, p.y) / 2, 1e-3);
                if (uv.x == 0) continue;
                EXPECT_NEAR(std::cos(2 * std::numbers::pi * uv.y), p.x / std::hypot(p.x, p.y), 1e-5);
                EXPECT_NEAR(std::sin(2 * std::numbers::pi * uv.y), p.y / std::hypot(p.x, p.y), 1e-5);
            }
        }
    }
}

TEST(Cylinder, NormalsPointAwayFromItsAxis) {
    const std::string ends =
        R"(<point name="p0" value="1,0,0"/><point name="p1" value="1,3,0"/><float name="radius" value="0.5"/>)";
    for (const bool flip : {false, true}) {
        const std::string parameter =
            ends + "<boolean name=\"flip_normals\" value=\"" + (flip ? "true" : "false") + "\"/>";
        const Mesh mesh = loadShape("<shape type=\"cylinder\">" + parameter + "</shape>").mesh;
        EXPECT_NEAR(areaOfMesh(mesh), 2 * std::numbers::pi * 0.5 * 3, 1e-3);
        ASSERT_EQ(mesh.cornerNormals.size(), 3 * mesh.triangles.size());
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            const glm::uvec3 corners = mesh.triangles[t];
            const unsigned index[] = {corners.x, corners.y, corners.z};
            for (size_t k = 0; k < 3; ++k) {
                const glm::vec3 p = mesh.positions[index[k]], outward = glm::normalize(glm::vec3(p.x - 1, 0, p.z));
                expectNear(glm::vec3(mesh.cornerNormals[3 * t + k]), flip ? -outward : outward, 1e-5f);
                EXPECT_NEAR(mesh.cornerUvs[3 * t + k].y, p.y / 3, 1e-6);
                EXPECT_GT(glm::dot(faceNormal(mesh, t), outward) * (flip ? -1 : 1), 0);
            }
        }
    }
    SceneFiles files;
    EXPECT_THAT(test::errorOf(files.write(
                    "bad.xml", sceneWith(R"(<shape type="cylinder"><point name="p1" value="0,0,0"/></shape>)"))),
                testing::HasSubstr("bad.xml:4:24: p0 and p1 of the cylinder are the same point"));
}

TEST(Sphere, CentreAndRadiusUnderSimilarity) {
    const ShapeDescription shape =
        loadShape(placed("sphere", R"(<scale value="2"/><rotate z="1" angle="90"/><translate x="1"/>)",
                         R"(<point name="center" x="1" y="2" z="3"/><float name="radius" value="0.5"/>)"));
    ASSERT_TRUE(shape.sphere);
    expectNear(shape.sphere->center, {-3, 2, 6});
    EXPECT_FLOAT_EQ(shape.sphere->radius, 1.0f);
    EXPECT_FALSE(shape.flipNormals);
    EXPECT_TRUE(loadShape(placed("sphere", R"(<scale value="-1"/>)")).flipNormals); // as Mitsuba 3 does
}

std::string meshShape(const std::string& type, const std::string& file, const std::string& more = "") {
    return "<shape type=\"" + type + "\"><string name=\"filename\" value=\"" + file + "\"/>" + more + "</shape>";
}

TEST(ObjMesh, FansQuadsAndCountsNegativeIndicesFromTheEnd) {
    const Mesh mesh =
        loadShape(meshShape("obj", dataFolder + "quads.obj", R"(<boolean name="face_normals" value="true"/>)")).mesh;
    ASSERT_EQ(mesh.positions.size(), 6u);
    ASSERT_EQ(mesh.triangles.size(), 4u);
    EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
    EXPECT_EQ(mesh.triangles[2], glm::uvec3(1, 4, 5));
    EXPECT_EQ(mesh.triangles[3], glm::uvec3(1, 5, 2));
    EXPECT_TRUE(mesh.cornerNormals.empty());
    expectNear(faceNormal(mesh, 0), {0, 0, 1});
}

// As CAD programs and scanners write them: nothing after a slash, edges among the faces, coordinates behind them.
TEST(ObjMesh, CornersMayBeCutShortAndComeFirst) {
    SceneFiles files;
    const auto meshOf = [&](const std::string& content, LoadChoice choice = {}) {
        files.write("a.obj", content);
        return loadScene(files.write("scene.xml", sceneWith(meshShape("obj", "a.obj"))), {}, choice).shapes.at(0).mesh;
    };
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", texture = "vt 0.25 0.75\n";
    for (const char* face : {"f 1// 2// 3//\n", "f 1/ 2/ 3/\n", "f 1 2\nf 3\nf 1 2 3\n"}) {
        const Mesh mesh = meshOf(points + face);
        EXPECT_EQ(mesh.triangles.size(), 1u) << face;
        EXPECT_TRUE(mesh.cornerUvs.empty()) << face;
    }
    for (const std::string& content : {points + texture + "f 1/1/ 2/1/ 3/1/\n", "f 1/1 2/1 3/1\n" + texture + points}) {
        const Mesh mesh = meshOf(content);
        ASSERT_EQ(mesh.cornerUvs.size(), 3u) << content;
        EXPECT_EQ(mesh.cornerUvs[2], glm::vec2(0.25f, 0.25f)) << content;
    }
    LoadChoice lenient;
    lenient.unknown = Unknown::forgiven;
    EXPECT_THROW(meshOf(points + "hello world\nf 1 2 3\n"), InputError);
    EXPECT_EQ(meshOf(points + "hello world\nf 1 2 3\n", lenient).triangles.size(), 1u);
}

TEST(ObjMesh, LinesMayContinueAndAByteOrderMarkComeFirst) {
    SceneFiles files;
    const auto sceneOf = [&](const std::string& content) {
        files.write("a.obj", content);
        return files.write("scene.xml", sceneWith(meshShape("obj", "a.obj")));
    };
    const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for (const std::string& content :
         {"\xef\xbb\xbf" + points + "f 1 2 3 4\n", points + "f 1 2\\\n3 \\\n 4", points + "f 1 2 \\\r\n\\\r\n3 4\r\n",
          points + "l 1 \\\n 2\n# of C:\\\nf 1 2 3 4\\", points + "f 1 2 3 4 \\\n# end \\\n"})
        EXPECT_EQ(loadScene(sceneOf(content)).shapes.at(0).mesh.triangles.size(), 2u) << content;
    EXPECT_THAT(test::errorOf(sceneOf(points + "f 1 \\\n 2 \\\n 3\nf 1 2 x\n")), testing::HasSubstr("a.obj:8: face"));
    EXPECT_THAT(test::errorOf(sceneOf(points + "f 1 \\\n 2 \\\n x\n")), testing::HasSubstr("a.obj:5: face"));
}

TEST(ObjMesh, NormalsThatAreMissingAreMeansWeightedByAngle) {
    // At the fold two triangles of either quad share vertex 1 (angles 45° + 45° left, 90° in two parts right): equal
    // weights.
    const Mesh mesh = loadShape(meshShape("obj", dataFolder + "quads.obj")).mesh;
    ASSERT_EQ(mesh.cornerNormals.size(), 12u);
    const glm::vec3 left(0, 0, 1), right = glm::normalize(glm::vec3(-1, 0, 1));
    expectNear(mesh.cornerNormals[0], left);
    expectNear(mesh.cornerNormals[1], glm::normalize(left + right));
    expectNear(mesh.cornerNormals[7], right);
}

TEST(ObjMesh, NormalsOfTheFileGoByTheInverseTranspose) {
    const Mesh mesh = loadShape(placed("obj", R"(<scale x="2"/>)",
                                       "<string name=\"filename\" value=\"" + dataFolder + "normals.obj\"/>"))
                          .mesh;
    ASSERT_EQ(mesh.cornerNormals.size(), 3u);
    expectNear(mesh.cornerNormals[1], glm::normalize(glm::vec3(0.3f, 0, 0.8f)));
    expectNear(mesh.cornerNormals[2], {0, 0.6f, 0.8f});
}

TEST(ObjMesh, WindingAgreesWithTheNormalsOfTheFile) {
    const std::string file = "<string name=\"filename\" value=\"" + dataFolder + "normals.obj\"/>";
    for (const char* parameters : {"", R"(<boolean name="flip_normals" value="true"/>)"}) {
        for (const char* operations : {"<scale x=\"1\"/>", "<scale x=\"-1\"/>", "<scale z=\"-1\"/>"}) {
            const Mesh mesh = loadShape(placed("obj", operations, file + parameters)).mesh;
            ASSERT_EQ(mesh.cornerNormals.size(), 3u);
            const bool up = (std::string(operations).find('z') == std::string::npos) == std::string(parameters).empty();
            for (const glm::vec3& normal : mesh.cornerNormals) {
                EXPECT_GT(glm::dot(normal, faceNormal(mesh, 0)), 0);
                EXPECT_EQ(normal.z > 0, up) << operations << parameters;
            }
        }
    }
}

TEST(ObjMesh, FlatFacesFollowTheWindingAfterMirroring) {
    const std::string file = "<string name=\"filename\" value=\"" + dataFolder +
                             "quads.obj\"/><boolean name=\"face_normals\" value=\"true\"/>";
    expectNear(faceNormal(loadShape(placed("obj", R"(<scale x="-1"/>)", file)).mesh, 0), {0, 0, -1});
    expectNear(
        faceNormal(
            loadShape(placed("obj", R"(<scale x="1"/>)", file + R"(<boolean name="flip_normals" value="true"/>)")).mesh,
            0),
        {0, 0, -1});
}

TEST(PlyMesh, TextureCoordinatesHaveThreeNames) {
    SceneFiles files;
    const auto uvsOf = [&](const std::string& u, const std::string& v) {
        files.write("a.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                    "property float " +
                        u + "\nproperty float " + v +
                        "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0 0.1 0.2\n1 0 0 0.3 0.4\n0 1 0 0.5 0.6\n3 0 1 2\n");
        return loadScene(files.write("scene.xml", sceneWith(meshShape("ply", "a.ply")))).shapes.at(0).mesh.cornerUvs;
    };
    const std::vector<glm::vec2> expected{{0.1f, 0.2f}, {0.3f, 0.4f}, {0.5f, 0.6f}};
    EXPECT_EQ(uvsOf("u", "v"), expected);
    EXPECT_EQ(uvsOf("s", "t"), expected);
    EXPECT_EQ(uvsOf("texture_u", "texture_v"), expected);
    EXPECT_TRUE(uvsOf("u", "t").empty()) << "of a pair, as in Mitsuba";
}

/// A tetrahedron's quad-and-triangle cousin: one quad, in any byte order, with a property to pass over and normals.
std::string binaryPly(bool bigEndian) {
    std::string out =
        std::string("ply\r\nformat binary_") + (bigEndian ? "big" : "little") +
        "_endian 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty float y\r\nproperty float z\r\nproperty "
        "uchar red\r\n"
        "property float nx\r\nproperty float ny\r\nproperty float nz\r\nelement edge 1\r\nproperty short a\r\n"
        "element face 1\r\nproperty list uchar ushort vertex_index\r\nproperty int flag\r\nend_header\r\n";
    const auto put = [&](auto value) {
        char bytes[sizeof(value)];
        std::memcpy(bytes, &value, sizeof(value));
        if (bigEndian) std::reverse(bytes, bytes + sizeof(value));
        out.append(bytes, sizeof(value));
    };
    const float corners[4][2] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
    for (const auto& corner : corners) {
        put(double(corner[0])), put(corner[1]), put(-3.5f), put(uint8_t(200));
        put(corner[0] > 0 ? 0.6f : -0.6f), put(0.0f), put(0.8f);
    }
    put(int16_t(-7));
    put(uint8_t(4)), put(uint16_t(0)), put(uint16_t(1)), put(uint16_t(2)), put(uint16_t(3)), put(int32_t(-1));
    return out;
}

TEST(PlyMesh, BinaryOfEitherByteOrderWithQuadsNormalsAndPropertiesToPassOver) {
    for (const bool bigEndian : {false, true}) {
        SceneFiles files;
        files.write("mesh.ply", binaryPly(bigEndian));
        const Mesh mesh =
            loadScene(files.write("scene.xml", sceneWith(meshShape("ply", "mesh.ply")))).shapes.at(0).mesh;
        ASSERT_EQ(mesh.triangles.size(), 2u);
        EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
        expectNear(mesh.positions[2], {2, 1, -3.5f});
        ASSERT_EQ(mesh.cornerNormals.size(), 6u);
        expectNear(mesh.cornerNormals[1], {0.6f, 0, 0.8f});
    }
}

TEST(PlyMesh, AByteOrderMarkIsPassedOver) {
    SceneFiles files;
    files.write("mesh.ply", "\xef\xbb\xbf" + binaryPly(false));
    EXPECT_EQ(loadScene(files.write("scene.xml", sceneWith(meshShape("ply", "mesh.ply")))).shapes.size(), 1u);
}

TEST(PlyMesh, AsciiTetrahedronLooksOutwards) {
    const Mesh mesh =
        loadShape(meshShape("ply", dataFolder + "tetrahedron.ply", R"(<boolean name="face_normals" value="true"/>)"))
            .mesh;
    ASSERT_EQ(mesh.triangles.size(), 4u);
    expectNear(faceNormal(mesh, 0), {0, 0, -1});
    expectNear(faceNormal(mesh, 3), glm::normalize(glm::vec3(1)));
}

} // namespace
} // namespace quasilux
