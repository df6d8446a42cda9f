// <shape type="serialized">: what files of both versions hold, as Mitsuba 3.9.1 reads them, and that no bytes do harm.
#include "support/scene_files.h"

#include <cstring>
#include <gmock/gmock.h>
#include <limits>
#include <random>
#include <zlib.h>

namespace quasilux {
namespace {

using test::errorOf;
using test::expectNear;
using test::SceneFiles;
using test::sceneWith;
using testing::HasSubstr;

template <typename T>
void append(std::string& bytes, T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T)); // of little endian, as is every machine that runs this
    bytes.append(raw, sizeof(T));
}

struct MeshBody {
    uint32_t flags = 0x1000;
    std::string name = "tent";
    std::vector<double> scalars = {-1, -1, 0, 1, -1, 0, 0, 1, 0.5}; ///< positions, normals, texture coordinates
    uint64_t vertices = 3, triangles = 1;
    std::vector<uint32_t> indices = {0, 1, 2};
};

/// What is compressed.
std::string bodyOf(const MeshBody& mesh, int version) {
    std::string body;
    append(body, mesh.flags);
    if (version >= 4) body += mesh.name + '\0';
    append(body, mesh.vertices);
    append(body, mesh.triangles);
    for (double value : mesh.scalars) mesh.flags & 0x2000 ? append(body, value) : append(body, float(value));
    for (uint32_t index : mesh.indices) append(body, index);
    return body;
}

std::string packed(const std::string& body, int version) {
    std::string file;
    append(file, uint16_t(0x041C));
    append(file, uint16_t(version));
    std::vector<Bytef> out(compressBound(body.size()));
    uLongf size = out.size();
    EXPECT_EQ(compress(out.data(), &size, reinterpret_cast<const Bytef*>(body.data()), body.size()), Z_OK);
    return file.append(reinterpret_cast<const char*>(out.data()), size);
}

std::string fileOf(const std::vector<MeshBody>& meshes, int version) {
    std::string file, table;
    for (const MeshBody& mesh : meshes) {
        version >= 4 ? append(table, uint64_t(file.size())) : append(table, uint32_t(file.size()));
        file += packed(bodyOf(mesh, version), version);
    }
    append(table, uint32_t(meshes.size()));
    return file + table;
}

std::string shapeOf(const std::string& parameters = "") {
    return sceneWith("<shape type=\"serialized\"><string name=\"filename\" value=\"m.serialized\"/>\n" + parameters +
                     "</shape>");
}

class SerializedVersions : public testing::TestWithParam<int> {};

TEST_P(SerializedVersions, TheMeshOfThatIndexIsRead) {
    SceneFiles files;
    MeshBody second;
    second.flags = 0x2003; // double, normals, texture coordinates
    second.scalars = {0, 0, 1, 2,          0, 1, 0, 2,   1,  /* normals */ 0, 0, 2, 0, 1, 1,
                      0, 0, 1, /* uv */ 0, 0, 1, 0, .25, .75};
    files.write("m.serialized", fileOf({MeshBody{}, second}, GetParam()));
    const Mesh first = loadScene(files.write("first.xml", shapeOf())).shapes.at(0).mesh;
    ASSERT_EQ(first.positions.size(), 3u);
    expectNear(first.positions[2], {0, 1, 0.5});
    EXPECT_TRUE(first.cornerUvs.empty());
    const Mesh mesh =
        loadScene(files.write("second.xml", shapeOf("<integer name=\"shape_index\" value=\"1\"/><transform "
                                                    "name=\"to_world\"><translate x=\"3\"/></transform>")))
            .shapes.at(0)
            .mesh;
    ASSERT_EQ(mesh.triangles.size(), 1u);
    expectNear(mesh.positions[1], {5, 0, 1});
    ASSERT_EQ(mesh.cornerNormals.size(), 3u);
    expectNear(mesh.cornerNormals[1], {0, 0.70710678f, 0.70710678f});
    ASSERT_EQ(mesh.cornerUvs.size(), 3u);
    EXPECT_EQ(mesh.cornerUvs[2], glm::vec2(.25f, .75f));
    const Mesh flat = loadScene(files.write("flat.xml", shapeOf("<integer name=\"shape_index\" value=\"1\"/><boolean "
                                                                "name=\"face_normals\" value=\"true\"/>")))
                          .shapes.at(0)
                          .mesh;
    EXPECT_TRUE(flat.cornerNormals.empty());
    EXPECT_THAT(errorOf(files.write("third.xml", shapeOf("<integer name=\"shape_index\" value=\"2\"/>"))),
                HasSubstr("third.xml:5:1: there is no mesh 2"));
    EXPECT_THAT(errorOf(files.write("back.xml", shapeOf("<integer name=\"shape_index\" value=\"-1\"/>"))),
                HasSubstr("back.xml:5:1: there is no mesh -1"));
}

struct BadBody {
    const char* name;
    MeshBody mesh;
    const char* message;
};
class BadSerialized : public testing::TestWithParam<BadBody> {};
TEST_P(BadSerialized, IsRefused) {
    SceneFiles files;
    files.write("m.serialized", fileOf({GetParam().mesh}, 4));
    EXPECT_THAT(errorOf(files.write("scene.xml", shapeOf())), HasSubstr(GetParam().message));
}
MeshBody with(const std::function<void(MeshBody&)>& change) {
    MeshBody mesh;
    change(mesh);
    return mesh;
}
const double notANumber = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    Serialized, BadSerialized,
    testing::Values(BadBody{"Index", with([](MeshBody& m) { m.indices[1] = 3; }),
                            "triangle 0: vertex 3 does not exist; there are 3"},
                    BadBody{"Nan", with([](MeshBody& m) { m.scalars[4] = notANumber; }),
                            "position 1 is not made of finite numbers"},
                    BadBody{"HugeCount", with([](MeshBody& m) { m.vertices = UINT64_MAX; }),
                            "vertices are more than the file can hold"},
                    BadBody{"LargeCount", with([](MeshBody& m) { m.vertices = 200000000; }),
                            "vertices are more than the file can hold"},
                    BadBody{"TooMany", with([](MeshBody& m) { m.vertices = 1000; }),
                            "m.serialized: position: the mesh ends too early"},
                    BadBody{"Faces", with([](MeshBody& m) { m.triangles = 2; }), "triangle: the mesh ends too early"},
                    BadBody{"LongName", with([](MeshBody& m) { m.name = std::string(1 << 24, 'a'); }),
                            "m.serialized: the mesh's name has more than 65536 bytes; shorten it"},
                    BadBody{"NoFaces", with([](MeshBody& m) { m.triangles = 0; }), "the mesh has no triangles"},
                    BadBody{"MissingNormals", with([](MeshBody& m) { m.flags |= 1; }), "the mesh ends too early"}),
    [](const auto& row) { return std::string(row.param.name); });

TEST(SerializedFiles, OtherFilesAreRefused) {
    SceneFiles files;
    const auto error = [&](const std::string& content, const std::string& parameters = "") {
        files.write("m.serialized", content);
        return errorOf(files.write("scene.xml", shapeOf(parameters)));
    };
    EXPECT_THAT(error(""), HasSubstr("m.serialized"));
    EXPECT_THAT(error("no mesh at all"), HasSubstr("m.serialized: this is not a serialized mesh"));
    std::string later = fileOf({MeshBody{}}, 4);
    later[2] = 9;
    EXPECT_THAT(error(later), HasSubstr("m.serialized: version 9; known: 3 and 4"));
    std::string huge = fileOf({MeshBody{}}, 4); // number of meshes
    huge.replace(huge.size() - 4, 4, "\xff\xff\xff\xff");
    EXPECT_THAT(error(huge, "<integer name=\"shape_index\" value=\"1\"/>"), HasSubstr("more than it can hold"));
    std::string far = fileOf({MeshBody{}, MeshBody{}}, 4); // offset of the second one
    far.replace(far.size() - 12, 8, "\xff\xff\xff\xff\xff\xff\xff\xff");
    EXPECT_THAT(error(far, "<integer name=\"shape_index\" value=\"1\"/>"), HasSubstr("the file ends too early"));
}

// Either a mesh or an InputError; anything else ends the program.
TEST_P(SerializedVersions, NoBytesDoHarm) {
    const int version = GetParam();
    std::mt19937 random(20);
    SceneFiles files;
    const std::string whole = fileOf({MeshBody{}, MeshBody{}}, version), body = bodyOf(MeshBody{}, version);
    const std::string scene = files.write("scene.xml", shapeOf("<integer name=\"shape_index\" value=\"1\"/>"));
    const std::string first = files.write("first.xml", shapeOf());
    unsigned refused = 0, read = 0;
    const auto load = [&](const std::string& path, const std::string& content) {
        files.write("m.serialized", content);
        try {
            loadScene(path);
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    };
    const auto changed = [&](std::string bytes) {
        for (unsigned k = 0; k <= random() % 3; ++k) bytes[random() % bytes.size()] = char(random());
        if (random() % 4 == 0) bytes.resize(random() % bytes.size());
        return bytes;
    };
    for (int k = 0; k < 400; ++k) {
        load(scene, changed(whole));
        load(first, packed(changed(body), version)); // what zlib would find to be damaged
    }
    EXPECT_GT(refused, 100u);
    EXPECT_GT(read, 10u);
}
INSTANTIATE_TEST_SUITE_P(Serialized, SerializedVersions, testing::Values(3, 4));

} // namespace
} // namespace quasilux
