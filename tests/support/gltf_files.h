// glTF files made in memory: JSON whose arrays lie in one buffer.
#pragma once

#include "support/scene_files.h"

#include <OpenImageIO/imageio.h>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace quasilux::test {

class GltfFile {
public:
    nlohmann::json json = {
        {"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", nlohmann::json::array()}}}}};

    /// Index of an accessor of these numbers.
    template <typename Number>
    int accessor(const std::vector<Number>& numbers, const std::string& type, int componentType,
                 bool normalized = false) {
        const size_t components = type == "SCALAR" ? 1 : static_cast<size_t>(type.back() - '0');
        nlohmann::json accessor = {{"bufferView", view(numbers.data(), numbers.size() * sizeof(Number))},
                                   {"componentType", componentType},
                                   {"count", numbers.size() / components},
                                   {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return add("accessors", accessor);
    }
    int floats(const std::vector<float>& numbers, const std::string& type) { return accessor(numbers, type, 5126); }

    int view(const void* data, size_t size) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        const size_t offset = bytes_.size();
        bytes_.resize(offset + size);
        std::memcpy(bytes_.data() + offset, data, size);
        return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    }
    /// Index of the new entry of a list.
    int add(const std::string& list, const nlohmann::json& entry) {
        json[list].push_back(entry);
        return static_cast<int>(json[list].size()) - 1;
    }
    /// And into the scene.
    int addNode(const nlohmann::json& node) {
        const int index = add("nodes", node);
        json["scenes"][0]["nodes"].push_back(index);
        return index;
    }
    int addImage(const std::string& encoded) {
        return add("images", {{"bufferView", view(encoded.data(), encoded.size())}, {"mimeType", "image/png"}});
    }
    /// A square of side 2 about the origin, seen from +z, with texture coordinates whose v runs down. Index of the
    /// mesh.
    int addSquare(const nlohmann::json& primitive = nlohmann::json::object()) {
        nlohmann::json whole = {{"attributes",
                                 {{"POSITION", floats({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, "VEC3")},
                                  {"TEXCOORD_0", floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2")}}},
                                {"indices", accessor<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", 5123)}};
        whole.merge_patch(primitive);
        return add("meshes", {{"primitives", {whole}}});
    }
    void addLight(const nlohmann::json& light, nlohmann::json node = nlohmann::json::object()) {
        auto& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
        lights.push_back(light);
        node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
        addNode(node);
    }

    /// Of the JSON and the buffer.
    std::string binary() const {
        nlohmann::json whole = json;
        std::string content(bytes_.begin(), bytes_.end());
        content.resize((content.size() + 3) / 4 * 4);
        if (!content.empty()) whole["buffers"] = {{{"byteLength", content.size()}}};
        std::string text = whole.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::string second = content.empty() ? "" : word(content.size()) + word(0x004e4942) + content;
        return "glTF" + word(2) + word(20 + text.size() + second.size()) + word(text.size()) + word(0x4e4f534a) + text +
               second;
    }
    /// Of the JSON alone; the buffer is a file of that name.
    std::string text(const std::string& bufferName) const {
        nlohmann::json whole = json;
        whole["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", bufferName}}};
        return whole.dump(1);
    }
    std::string buffer() const { return {bytes_.begin(), bytes_.end()}; }

private:
    static std::string word(size_t number) {
        std::string bytes;
        for (int k = 0; k < 4; ++k) bytes += static_cast<char>(number >> (8 * k) & 255);
        return bytes;
    }

    std::vector<char> bytes_;
};

/// Tests that load such files.
class GltfTest : public testing::Test {
protected:
    Scene load(const GltfFile& file, const LoadChoice& choice = {}) const {
        return loadScene(files.write("scene.glb", file.binary()), {}, choice);
    }
    /// A square with this material.
    static GltfFile squareOf(const nlohmann::json& material, GltfFile file = {}) {
        file.add("materials", material);
        file.addNode({{"mesh", file.addSquare({{"material", 0}})}});
        return file;
    }
    static Bsdf bsdfOf(const Scene& scene) { return scene.bsdfs.at(static_cast<size_t>(scene.shapes.at(0).bsdf)); }
    /// Encoded, of 2 x 2 pixels with these channels.
    std::string png(const std::vector<uint8_t>& pixels) const {
        const std::string path = files.path("image.png");
        auto output = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(2, 2, static_cast<int>(pixels.size()) / 4, OIIO::TypeDesc::UINT8);
        spec["oiio:UnassociatedAlpha"] = 1;
        output->open(path, spec);
        output->write_image(OIIO::TypeDesc::UINT8, pixels.data());
        output->close();
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    SceneFiles files;
};

} // namespace quasilux::test
