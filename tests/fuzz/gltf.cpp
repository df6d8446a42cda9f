// A glTF file of either form, which is not trusted, without files beside it.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "scene/scene.h"

namespace quasilux::fuzz {

void readGltf(std::string_view input) {
    expectInputErrors([&] { loadScene(write("scene.glb", input), {}, choiceOf(input)); });
}

} // namespace quasilux::fuzz
