// Files of others: the models of Debian's package assimp-testmodels are loaded, or refused by name. Skipped where it is
// not installed.
#include "support/scene_files.h"

#include <algorithm>
#include <set>

namespace quasilux {
namespace {

namespace fs = std::filesystem;

const fs::path models = "/usr/share/assimp/models";

/// Of glTF 2.0, refused for what is wrong with them or required of readers; and those of points and lines alone.
const std::set<std::string> refused{"BoxWithInfinites.glb",
                                    "2CylinderEngine.gltf",
                                    "AllIndicesOutOfRange.gltf",
                                    "IndexOutOfRange.gltf",
                                    "RecursiveNodes.gltf",
                                    "sceneWrongType.gltf",
                                    "NoScene.gltf",
                                    "SceneWithoutNodes.gltf",
                                    "badArray.gltf",
                                    "badNumber.gltf",
                                    "Mesh_PrimitiveMode_00.gltf",
                                    "Mesh_PrimitiveMode_01.gltf",
                                    "Mesh_PrimitiveMode_02.gltf",
                                    "Mesh_PrimitiveMode_03.gltf",
                                    "Mesh_PrimitiveMode_07.gltf",
                                    "Mesh_PrimitiveMode_08.gltf",
                                    "Mesh_PrimitiveMode_09.gltf",
                                    "Mesh_PrimitiveMode_10.gltf"};

TEST(GltfModels, AreLoadedOrRefusedByName) {
    if (!fs::is_directory(models)) GTEST_SKIP() << "install assimp-testmodels for it";
    size_t loaded = 0;
    for (const auto& entry : fs::recursive_directory_iterator(models)) {
        const std::string path = entry.path().string(), name = entry.path().filename().string();
        if (entry.path().extension() != ".gltf" && entry.path().extension() != ".glb") continue;
        const bool isFirstVersion = path.find("/glTF/") != std::string::npos;
        const bool isOutside = path.find("MissingBin") != std::string::npos || path.find("WebGL") != std::string::npos;
        const auto message = refusal([&] { loadScene(path); });
        EXPECT_EQ(message.has_value(), isFirstVersion || isOutside || refused.count(name) > 0)
            << path << ": " << message.value_or("loaded");
        if (message) {
            EXPECT_THAT(*message, testing::HasSubstr(name));
        }
        loaded += !message;
    }
    EXPECT_GT(loaded, 15u);
}

} // namespace
} // namespace quasilux
