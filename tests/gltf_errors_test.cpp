// Bad glTF files are refused with the file, the place in its JSON, and what was expected.
#include "support/gltf_files.h"
#include "support/scene_files.h"

#include <fmt/format.h>

namespace quasilux {
namespace {

using nlohmann::json;
using test::GltfFile;
using testing::AllOf;
using testing::HasSubstr;

/// A luminaire of EXT_lights_ies at the first node.
void addProfile(json& file, const json& profile) {
    file["extensions"]["EXT_lights_ies"]["lights"] = {profile};
    file["nodes"][0]["extensions"]["EXT_lights_ies"]["light"] = 0;
}

class GltfErrors : public testing::Test {
protected:
    /// The message for a square, which `change` spoils.
    std::string error(const std::function<void(json&)>& change) const {
        GltfFile file;
        file.add("materials", json::object());
        file.addNode({{"mesh", file.addSquare({{"material", 0}})}});
        change(file.json);
        return errorOf(file.binary());
    }
    std::string errorOf(const std::string& content, const std::string& name = "scene.glb") const {
        const std::string message = test::errorOf(files.write(name, content));
        EXPECT_THAT(message, HasSubstr(name + ":"));
        return message;
    }
    test::SceneFiles files;
};

TEST_F(GltfErrors, NameThePlace) {
    const std::vector<std::pair<std::function<void(json&)>, std::string>> cases{
        {[](json& j) { j["accessors"][0]["count"] = 5; }, "accessors[0]: 5 elements of 12 bytes, 12 from each to the "
                                                          "next, from byte 0 on, reach beyond bufferViews[0] of 48"},
        {[](json& j) { j["accessors"][0]["count"] = 4000000000u; }, "accessors[0]: 4000000000 elements"},
        {[](json& j) { j["accessors"][0].erase("bufferView"), j["accessors"][0]["count"] = 4000000000u; },
         "there is nothing to see"},
        {[](json& j) { j["accessors"][1].erase("bufferView"), j["accessors"][1]["count"] = 4000000000u; },
         "accessors[1]: 4000000000 elements without a bufferView; expected at most"},
        {[](json& j) { j["accessors"][0]["byteOffset"] = 18446744073709551600u; }, "reach beyond bufferViews[0]"},
        {[](json& j) { j["accessors"][0]["bufferView"] = 99; }, "accessors[0]: bufferViews[99] does not exist"},
        {[](json& j) { j["accessors"][0]["type"] = "VEC2"; }, "elements of 2 numbers, but"},
        {[](json& j) { j["accessors"][1]["count"] = 3; }, "TEXCOORD_0 has 3 elements, but POSITION has 4"},
        {[](json& j) { j["accessors"][2]["componentType"] = 5126; }, "accessors[2]: "},
        {[](json& j) { j["bufferViews"][0]["byteLength"] = 1000000; }, "bufferViews[0]: 1000000 bytes from byte 0 on"},
        {[](json& j) { j["bufferViews"][0]["buffer"] = 7; }, "buffers[7] does not exist; the file has 1"},
        {[](json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 44; },
         "accessors[44] does not exist"},
        {[](json& j) { j["meshes"][0]["primitives"][0]["material"] = 3; },
         "materials[3] does not exist; the file has 1"},
        {[](json& j) { j["meshes"][0]["primitives"][0]["mode"] = 9; }, "unknown mode 9"},
        {[](json& j) {
             j["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5}}}}}};
         },
         "`baseColorFactor` parameter in pbrMetallicRoughness must be 4, but got 3"},
        {[](json& j) { j["nodes"][0]["mesh"] = 3; }, "nodes[0]: meshes[3] does not exist"},
        {[](json& j) { j["nodes"][0]["children"] = {0}; }, "nodes[0]: the node has two parents, or is its own child"},
        {[](json& j) { j["nodes"][0]["children"] = {5}; }, "nodes[0]: nodes[5] does not exist"},
        {[](json& j) {
             j["nodes"][0]["rotation"] = {0, 0, 0, 0};
         },
         "nodes[0]: the rotation is no quaternion"},
        {[](json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }, "not affine"},
        {[](json& j) { j["scene"] = 4; }, "scenes[4] does not exist; the file has 1"},
        {[](json& j) { j["scenes"][0]["nodes"] = json::array(); }, "there is nothing to see"},
        {[](json& j) { j["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 2; },
         "materials[0]: metallicFactor is 2; expected 0 to 1"},
        {[](json& j) { j["materials"][0]["alphaMode"] = "GLASS"; }, "unknown alphaMode 'GLASS'"},
        {[](json& j) {
             j["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 6}};
         },
         "materials[0]: textures[6] does not exist; the file has 0"},
        {[](json& j) { j["materials"][0]["extensions"]["KHR_materials_ior"]["ior"] = 0.5; },
         "ior is 0.5; expected 1 to"},
        {[](json& j) { j["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2; },
         "KHR_lights_punctual.lights[2] does not exist"},
        {[](json& j) { j["nodes"][0]["extensions"]["EXT_lights_ies"]["light"] = 0; },
         "nodes[0]: EXT_lights_ies.lights[0] does not exist; the file has 0"},
        {[](json& j) {
             addProfile(j, {{"name", "none"}});
         },
         "EXT_lights_ies.lights[0]: expected either 'uri' or"},
        {[](json& j) {
             addProfile(j, {{"uri", "none.ies"}});
         },
         "nodes[0]: cannot read the luminaire file"},
        {[](json& j) {
             addProfile(j, {{"uri", "data:text/plain"}});
         },
         "the data URI has no comma"},
        {[](json& j) {
             addProfile(j, {{"uri", "data:;base64,SUVTTkE5MQo="}});
         },
         "EXT_lights_ies.lights[0]:1: the file has no line TILT=NONE"},
        {[](json& j) {
             addProfile(j, {{"bufferView", 99}});
         },
         "bufferViews[99] does not exist"},
        {[](json& j) { j["nodes"][0]["extras"]["ies"] = 5; }, "nodes[0].extras: 'ies' is no text"},
        {[](json& j) { j["nodes"][0]["extras"]["ies"] = "none.ies"; }, "nodes[0]: cannot read the luminaire file"},
        {[](json& j) { j["asset"]["version"] = "1.0"; }, "asset: glTF version 1.0; expected 2.0"},
        {[](json& j) {
             j["scenes"][0]["extras"]["quasilux"] = {{"bdd", "many"}};
         },
         "scenes.extras: bdd"}};
    for (const auto& [change, message] : cases) EXPECT_THAT(error(change), HasSubstr(message));
}

TEST_F(GltfErrors, OfIndicesAndNumbers) {
    GltfFile file;
    file.addNode({{"mesh", file.addSquare({{"indices", file.accessor<uint16_t>({0, 1, 65535}, "SCALAR", 5123)}})}});
    EXPECT_THAT(errorOf(file.binary()), HasSubstr("accessors[0]: index 65535 at place 2 does not exist; there are 4"));
    GltfFile infinite;
    const int positions = infinite.floats({0, 0, 0, 1, 0, 0, 0, INFINITY, 0}, "VEC3");
    infinite.add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
    infinite.addNode({{"mesh", 0}});
    EXPECT_THAT(errorOf(infinite.binary()), HasSubstr("accessors[0]: element 2 is not made of finite numbers"));
}

TEST_F(GltfErrors, RequiredExtensions) {
    GltfFile file;
    file.addNode({{"mesh", file.addSquare()}});
    file.json["extensionsRequired"] = {"KHR_texture_transform", "KHR_draco_mesh_compression"};
    EXPECT_THAT(errorOf(file.binary()),
                AllOf(HasSubstr("requires the extension 'KHR_draco_mesh_compression'"), HasSubstr("--lenient")));
    const Scene scene = loadScene(files.write("scene.glb", file.binary()), {}, {{}, Unknown::forgiven});
    EXPECT_THAT(scene.warnings, testing::Contains(HasSubstr("'KHR_draco_mesh_compression' is not supported")));
}

TEST_F(GltfErrors, MalformedFiles) {
    GltfFile file;
    file.addNode({{"mesh", file.addSquare()}});
    const std::string whole = file.binary();
    for (size_t size : {0, 3, 10, 19, 40, 300})
        EXPECT_THAT(errorOf(whole.substr(0, size)), AllOf(testing::Not(HasSubstr("unknown")))) << size;
    EXPECT_THAT(errorOf(whole.substr(0, whole.size() - 8)), HasSubstr("malformed GLB: its header states"));
    EXPECT_THAT(errorOf("{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [", "scene.gltf"),
                HasSubstr("scene.gltf:1:41: malformed JSON: syntax error while"));
    const std::string deep =
        "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + std::string(100000, '[') + std::string(100000, ']') + "}";
    EXPECT_THAT(errorOf(deep, "scene.gltf"), HasSubstr("JSON nested deeper than 100"));
    EXPECT_THAT(errorOf(file.text("missing.bin"), "scene.gltf"), HasSubstr("missing.bin': there is no such file"));
    files.write("short.bin", file.buffer().substr(0, 20));
    EXPECT_THAT(errorOf(file.text("short.bin"), "scene.gltf"), HasSubstr("not a valid glTF file"));
}

TEST_F(GltfErrors, ParametersHaveNoPlace) {
    GltfFile file;
    file.addNode({{"mesh", file.addSquare()}});
    EXPECT_THAT(test::errorOf(files.write("scene.glb", file.binary()), {{"size", "4"}}),
                HasSubstr("parameter 'size' is not used by the scene"));
}

TEST_F(GltfErrors, UntrustedOnesStayInTheirFolder) {
    GltfFile file;
    file.addNode({{"mesh", file.addSquare()}});
    std::filesystem::create_directories(files.path("inside"));
    files.write("outside.bin", file.buffer());
    const auto message = [&](const std::string& buffer, const LoadLimits& limits = {}) {
        const std::string path = files.write("inside/scene.gltf", file.text(buffer));
        return refusal([&] { loadScene(path, {}, {{}, Unknown::refused, limits}); }).value_or("");
    };
    EXPECT_THAT(message("../outside.bin"), HasSubstr("lies outside of the scene's folder"));
    EXPECT_THAT(message("..%2Foutside.bin"), HasSubstr("lies outside of the scene's folder"));
    EXPECT_THAT(message(files.path("outside.bin")), HasSubstr("lies outside of the scene's folder"));
    LoadLimits open;
    open.staysInside = false;
    EXPECT_EQ(message("../outside.bin", open), "");
    open.elements = 1;
    EXPECT_THAT(message("../outside.bin", open), HasSubstr("more than 1 elements"));
}

} // namespace
} // namespace quasilux
