// Images of textures. The first byte chooses the format, as the ending of a name does.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "scene/textures/texture_plugin.h"

#include <array>

namespace quasilux::fuzz {

void readImageFile(std::string_view input) {
    constexpr std::array<const char*, 8> endings{".exr", ".hdr", ".png", ".jpg", ".tif", ".bmp", ".tga", ".pfm"};
    if (input.empty()) return;
    const std::string name = std::string("a") + endings[static_cast<unsigned char>(input[0]) % endings.size()];
    const std::string path = write(name, input.substr(1));
    LoadLimits limits;
    limits.pixels = 1 << 20;
    for (const bool emits : {false, true}) {
        LoadGuard guard((folder() / "scene.xml").string(), limits);
        expectInputErrors([&] {
            guard.withinMemory([&] {
                if (emits)
                    readImage(path, true, TextureUse::emission, {path}, guard);
                else
                    readImage(path, false, TextureUse::reflectance, {path}, guard);
            });
        });
    }
}

} // namespace quasilux::fuzz
