// What a glTF file means: the scene that it gives is that of XML which says the same.
#include "support/gltf_files.h"

#include <fmt/format.h>
#include <numbers>

namespace quasilux {
namespace {

using nlohmann::json;
using test::GltfFile;
using testing::ElementsAre;
using testing::HasSubstr;

class Gltf : public test::GltfTest {
protected:
    Bsdf bsdfOfMaterial(const json& material) const { return bsdfOf(load(squareOf(material))); }
    Bsdf bsdfOfXml(const std::string& bsdf) const {
        return bsdfOf(
            loadScene(files.write("scene.xml", test::sceneWith("<shape type=\"rectangle\">" + bsdf + "</shape>"))));
    }
};

void expectSameLobes(const std::vector<LobeDescription>& a, const std::vector<LobeDescription>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t k = 0; k < a.size(); ++k) {
        EXPECT_EQ(std::memcmp(&a[k].device, &b[k].device, sizeof(shared::Lobe)), 0) << a[k].name;
        EXPECT_EQ(a[k].name, b[k].name);
    }
}

void expectSameBsdf(const Bsdf& a, const Bsdf& b) {
    expectSameLobes(a.front, b.front);
    expectSameLobes(a.back, b.back);
}

std::vector<glm::vec3> cornersOf(const Mesh& mesh) {
    std::vector<glm::vec3> corners;
    for (const glm::uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) corners.push_back(mesh.positions[t[k]]);
    return corners;
}

TEST_F(Gltf, IndicesOfAllTypesAndModes) {
    const std::vector<glm::vec3> square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const auto cornersWith = [&](const std::function<json(GltfFile&)>& primitive) {
        GltfFile file;
        const json changes = primitive(file);
        file.addNode({{"mesh", file.addSquare(changes)}});
        return cornersOf(load(file).shapes.at(0).mesh);
    };
    const auto as = [&](auto number, int type) {
        return cornersWith([&](GltfFile& f) {
            return json{{"indices", f.accessor<decltype(number)>({0, 1, 2, 0, 2, 3}, "SCALAR", type)}};
        });
    };
    EXPECT_EQ(as(uint8_t(), 5121), square);
    EXPECT_EQ(as(uint16_t(), 5123), square);
    EXPECT_EQ(as(uint32_t(), 5125), square);
    const auto mode = [&](int number, std::vector<uint8_t> indices) {
        return cornersWith([&](GltfFile& f) {
            return json{{"mode", number}, {"indices", f.accessor(indices, "SCALAR", 5121)}};
        });
    };
    const std::vector<glm::vec3> strip{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    EXPECT_EQ(mode(5, {0, 1, 3, 2}), strip);
    EXPECT_EQ(mode(6, {0, 1, 2, 3}).size(), 6u);
    // Without indices: the vertices in their order, and one left over.
    EXPECT_EQ(cornersWith([](GltfFile&) { return json{{"indices", nullptr}}; }).size(), 3u);
}

TEST_F(Gltf, NodesTransformEachOther) {
    GltfFile file;
    const int mesh = file.addSquare();
    const double half = std::sqrt(0.5); // a quarter turn about z
    file.add("nodes", {{"mesh", mesh}, {"scale", {2, 3, 1}}});
    file.addNode({{"translation", {5, 0, 0}}, {"rotation", {0, 0, half, half}}, {"children", {0}}});
    file.addNode({{"mesh", mesh}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}}); // the same
    const Scene scene = load(file);
    ASSERT_EQ(scene.shapes.size(), 2u);
    for (size_t k = 0; k < 4; ++k)
        EXPECT_LT(glm::length(scene.shapes[0].mesh.positions[k] - scene.shapes[1].mesh.positions[k]), 1e-5);
    EXPECT_LT(glm::length(scene.shapes[0].mesh.positions[1] - glm::vec3(8, 2, 0)), 1e-5); // of (1, -1, 0)
}

// A mirror swaps the winding in the world, but not the side that is the front.
TEST_F(Gltf, MirroredNodesKeepTheirFront) {
    for (const double x : {1.0, -1.0}) {
        GltfFile file;
        file.addNode({{"mesh", file.addSquare()}, {"scale", {x, 1, 1}}});
        const Mesh mesh = load(file).shapes.at(0).mesh;
        const auto corners = cornersOf(mesh);
        EXPECT_GT(glm::cross(corners[1] - corners[0], corners[2] - corners[0]).z, 0) << x;
    }
}

TEST_F(Gltf, InstancesOfOneNode) {
    GltfFile file;
    const int places = file.floats({0, 0, 0, 7, 0, 0, 0, 7, 0}, "VEC3");
    file.addNode({{"mesh", file.addSquare()},
                  {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}});
    const Scene scene = load(file);
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_EQ(scene.shapes[1].mesh.positions[0], glm::vec3(6, -1, 0));
}

TEST_F(Gltf, SparseAndQuantizedAccessors) {
    GltfFile file;
    const int mesh = file.addSquare();
    const int index = file.view(std::vector<uint8_t>{2}.data(), 1);
    const int value = file.view(std::vector<float>{9, 8, 7}.data(), 12);
    json& primitive = file.json["meshes"][0]["primitives"][0];
    const int positions = primitive["attributes"]["POSITION"];
    file.json["accessors"][static_cast<size_t>(positions)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", index}, {"componentType", 5121}}},
        {"values", {{"bufferView", value}}}};
    primitive["attributes"]["TEXCOORD_0"] =
        file.accessor<uint8_t>({0, 255, 255, 255, 255, 0, 0, 0}, "VEC2", 5121, true);
    file.addNode({{"mesh", mesh}});
    const Mesh loaded = load(squareOf({{"pbrMetallicRoughness", json::object()}}, file)).shapes.at(0).mesh;
    EXPECT_EQ(loaded.positions[2], glm::vec3(9, 8, 7));
    EXPECT_EQ(loaded.cornerUvs.at(1), glm::vec2(1, 1));
}

TEST_F(Gltf, MetallicRoughnessIsPrincipled) {
    const json pbr = {{"baseColorFactor", {0.8, 0.4, 0.2, 1}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.5}};
    const std::string xml = "<rgb name=\"base_color\" value=\"0.8,0.4,0.2\"/><float name=\"metallic\" value=\"0.25\"/>"
                            "<float name=\"roughness\" value=\"0.5\"/>";
    const auto principled = [&](const std::string& more) {
        return bsdfOfXml("<bsdf type=\"principled\">" + xml + more + "</bsdf>");
    };
    expectSameBsdf(bsdfOfMaterial({{"pbrMetallicRoughness", pbr}}), principled("<float name=\"eta\" value=\"1.5\"/>"));
    const Bsdf both = bsdfOfMaterial({{"pbrMetallicRoughness", pbr}, {"doubleSided", true}});
    EXPECT_EQ(both.plugin, "twosided");
    expectSameLobes(both.front, both.back);
    expectSameBsdf(bsdfOfMaterial({{"pbrMetallicRoughness", pbr},
                                   {"extensions",
                                    {{"KHR_materials_ior", {{"ior", 1.33}}},
                                     {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}}}}}}),
                   principled("<float name=\"eta\" value=\"1.33\"/><float name=\"clearcoat\" value=\"0.5\"/>"
                              "<float name=\"clearcoat_gloss\" value=\"1\"/>"));
    const Bsdf dull = bsdfOfMaterial(
        {{"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}, {"pbrMetallicRoughness", pbr}});
    expectSameBsdf(dull, principled("<float name=\"eta\" value=\"1.0001\"/>"));
    EXPECT_EQ(principled("<float name=\"eta\" value=\"1\"/>").front.size(), 1u) << "no metal either, as in Mitsuba";
    json matt = pbr;
    matt["metallicFactor"] = 0;
    expectSameBsdf(bsdfOfMaterial({{"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}},
                                   {"pbrMetallicRoughness", matt}}),
                   bsdfOfXml("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.8,0.4,0.2\"/></bsdf>"));
}

TEST_F(Gltf, WhatEmitsShinesFromItsFrontAlone) {
    const auto warnings = [&](bool doubleSided) {
        return load(squareOf({{"emissiveFactor", {1, 1, 1}}, {"doubleSided", doubleSided}})).warnings;
    };
    EXPECT_THAT(warnings(true), testing::Contains(HasSubstr("the backs of doubleSided materials that emit")));
    EXPECT_THAT(warnings(false), testing::Not(testing::Contains(HasSubstr("doubleSided"))));
}

TEST_F(Gltf, TransmissionIsGlass) {
    const auto glass = [&](const json& more, double roughness) {
        json extensions = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}};
        extensions.merge_patch(more);
        return load(
            squareOf({{"pbrMetallicRoughness",
                       {{"baseColorFactor", {0.25, 1, 1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", roughness}}},
                      {"extensions", extensions}}));
    };
    const std::string index = "<float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/>";
    expectSameBsdf(bsdfOf(glass(json::object(), 0)),
                   bsdfOfXml("<bsdf type=\"thindielectric\">" + index +
                             "<rgb name=\"specular_transmittance\" value=\"0.25,1,1\"/></bsdf>"));
    EXPECT_EQ(bsdfOf(glass(json::object(), 0.5)).plugin, "principledthin");
    const json body = {{"KHR_materials_volume",
                        {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {0.5, 1, 1}}}}};
    const Scene solid = glass(body, 0);
    expectSameBsdf(bsdfOf(solid), bsdfOfXml("<bsdf type=\"dielectric\">" + index +
                                            "<rgb name=\"specular_transmittance\" value=\"0.5,1,1\"/></bsdf>"));
    ASSERT_TRUE(solid.shapes[0].interior);
    EXPECT_NEAR(solid.media.at(*solid.shapes[0].interior).sigmaT.r, std::numbers::ln2 / 2, 1e-6);
    EXPECT_EQ(solid.media.at(*solid.shapes[0].interior).sigmaT.g, 0);
    expectSameBsdf(bsdfOf(glass(body, 0.5)),
                   bsdfOfXml("<bsdf type=\"roughdielectric\">" + index +
                             "<string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"0.25\"/>"
                             "<rgb name=\"specular_transmittance\" value=\"0.5,1,1\"/></bsdf>"));
}

TEST_F(Gltf, TexturesByTheirMeaning) {
    GltfFile file;
    file.addImage(png({255, 0, 0, 128, 0, 255, 64, 255, 0, 128, 0, 255, 0, 64, 0, 0}));
    file.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33071}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    const json texture = {{"index", 0},
                          {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 3}}}}}}};
    const Scene scene =
        load(squareOf({{"pbrMetallicRoughness",
                        {{"baseColorTexture", texture},
                         {"baseColorFactor", {0.5, 1, 1, 1}},
                         {"metallicRoughnessTexture", {{"index", 0}}},
                         {"roughnessFactor", 0.5}}},
                       {"emissiveTexture", {{"index", 0}}},
                       {"emissiveFactor", {1, 1, 1}},
                       {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 10}}}}},
                       {"alphaMode", "MASK"}},
                      file));
    const auto textureOf = [&](const std::function<bool(const TextureDescription&)>& is) {
        for (const TextureDescription& each : scene.textures)
            if (is(each)) return each;
        ADD_FAILURE();
        return TextureDescription();
    };
    const TextureDescription base = textureOf([](const auto& t) { return t.device.toU[0] == 2 && t.texels[0].r != 1; });
    EXPECT_EQ(base.device.filter, unsigned(TEXTURE_NEAREST));
    EXPECT_EQ(base.device.wrap, unsigned(WRAP_CLAMP));
    EXPECT_THAT(base.device.toU, ElementsAre(2, 0, 0.5f));
    EXPECT_THAT(base.device.toV, ElementsAre(0, 3, 0));
    EXPECT_NEAR(base.texels[0].r, 0.5, 1e-6);       // times the factor
    EXPECT_NEAR(base.texels[2].g, 0.2158605, 1e-5); // sRGB 128
    const TextureDescription emission = textureOf([](const auto& t) { return t.use == TextureUse::emission; });
    EXPECT_NEAR(emission.texels[0].r, 10, 1e-5);
    ASSERT_TRUE(scene.shapes[0].emitter);
    // Roughness is linear, in green; metal is in blue; and the mask cuts at one half.
    textureOf([](const auto& t) { return std::abs(t.texels[1].r - 0.5f) < 1e-6 && t.texels[0].r == 0; });
    textureOf([](const auto& t) { return std::abs(t.texels[1].r - 64 / 255.f) < 1e-6 && t.texels[0].r == 0; });
    textureOf([](const auto& t) { return t.texels[0].r == 1 && t.texels[3].r == 0 && t.texels[2].r == 1; });
    EXPECT_EQ(bsdfOf(scene).plugin, "mask");
}

/// Bitmaps of the scene by the red of their pixels.
bool hasBitmap(const Scene& scene, const std::vector<float>& reds) {
    return std::any_of(scene.textures.begin(), scene.textures.end(), [&](const TextureDescription& each) {
        if (each.texels.size() != reds.size()) return false;
        for (size_t k = 0; k < reds.size(); ++k)
            if (std::abs(each.texels[k].r - reds[k]) > 1e-4f) return false;
        return true;
    });
}

TEST_F(Gltf, TexturesOfCoatAndSpecular) {
    const auto sceneOf = [&](const json& extensions) {
        GltfFile file;
        file.addImage(png({255, 0, 0, 128, 0, 255, 64, 255, 0, 128, 0, 255, 0, 64, 0, 0}));
        file.add("textures", {{"source", 0}});
        return load(squareOf(
            {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.5}}}, {"extensions", extensions}},
            file));
    };
    const json texture = {{"index", 0}};
    const Scene coated = sceneOf({{"KHR_materials_clearcoat",
                                   {{"clearcoatFactor", 0.5},
                                    {"clearcoatRoughnessFactor", 0.3},
                                    {"clearcoatTexture", texture},
                                    {"clearcoatRoughnessTexture", texture}}}});
    // The coat is in red; its roughness r in green, of which Mitsuba's gloss is (0.1 - r²) / 0.099.
    EXPECT_TRUE(hasBitmap(coated, {0.5f, 0, 0, 0}));
    const auto gloss = [](double green) { return static_cast<float>((0.1 - 0.09 * green * green) / 0.099); };
    EXPECT_TRUE(hasBitmap(coated, {1, gloss(1), gloss(128 / 255.0), gloss(64 / 255.0)}));
    EXPECT_FALSE(hasBitmap(coated, {1, gloss(0), gloss(1), gloss(0)})) << "control";
    EXPECT_THAT(coated.warnings, testing::Not(testing::Contains(HasSubstr("clearcoat"))));
    const auto coats = [](const Scene& scene) {
        const Bsdf bsdf = bsdfOf(scene);
        return std::count_if(bsdf.front.begin(), bsdf.front.end(),
                             [](const LobeDescription& lobe) { return lobe.name == "clearcoat"; });
    };
    EXPECT_EQ(coats(coated), 1);
    EXPECT_EQ(coats(sceneOf({{"KHR_materials_clearcoat", {{"clearcoatTexture", texture}}}})), 0) << "a factor of 0";

    const Scene specular = sceneOf({{"KHR_materials_specular", {{"specularTexture", texture}}}});
    EXPECT_EQ(bsdfOf(specular).plugin, "blendbsdf");
    EXPECT_TRUE(hasBitmap(specular, {128 / 255.f, 1, 1, 0})) << "in alpha";
    const Scene byColor = sceneOf({{"KHR_materials_specular", {{"specularColorTexture", texture}}}});
    const auto linear = [](double code) { return std::pow((code / 255 + 0.055) / 1.055, 2.4); };
    EXPECT_TRUE(
        hasBitmap(byColor, {0.2126f, static_cast<float>(0.7152 + 0.0722 * linear(64)),
                            static_cast<float>(0.7152 * linear(128)), static_cast<float>(0.7152 * linear(64))}));
    EXPECT_THAT(byColor.warnings, testing::Contains(HasSubstr("colours of specularColorTexture")));
}

TEST_F(Gltf, VertexColors) {
    GltfFile file;
    file.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 1, 1}}}}, {"alphaMode", "BLEND"}});
    const int colors = file.accessor<uint16_t>({65535, 0, 0, 65535, 0, 65535, 0, 65535, 0, 0, 65535, 65535, 0, 0, 0, 0},
                                               "VEC4", 5123, true);
    file.addNode({{"mesh", file.addSquare({{"material", 0}, {"attributes", {{"COLOR_0", colors}}}})}});
    const Mesh mesh = load(file).shapes.at(0).mesh;
    ASSERT_EQ(mesh.attributes.size(), 2u);
    const bool first = mesh.attributes[0].name == "vertex_color";
    const MeshAttribute &color = mesh.attributes[first ? 0 : 1], &alpha = mesh.attributes[first ? 1 : 0];
    EXPECT_EQ(color.values.at(0).r, 0.5f);
    EXPECT_EQ(alpha.name, "vertex_alpha");
    EXPECT_EQ(alpha.values.at(3).r, 0);
}

} // namespace
} // namespace quasilux
