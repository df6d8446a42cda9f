// A glTF file of either form, which is not trusted, without files beside it.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "scene/scene.h"

namespace quasilux::fuzz {

void readGltf(std::string_view input) {
    LoadChoice choice;
    choice.unknown = input.size() % 2 == 0 ? Unknown::refused : Unknown::forgiven;
    choice.limits.emplace();
    choice.limits->elements = 2000;
    choice.limits->pixels = 1 << 20;
    choice.limits->seconds = 20;
    expectInputErrors([&] { loadScene(write("scene.glb", input), {}, choice); });
}

} // namespace quasilux::fuzz
