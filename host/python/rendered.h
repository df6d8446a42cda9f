// A render by Python code, and what it came to.
#pragma once

#include "output/exr.h"
#include "python/render_watch.h"
#include "scene/scene.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

struct LoadedScene {
    std::shared_ptr<const Scene> scene;
    double loadSeconds = 0;
};

struct Rendered {
    FilmImage image;
    RenderRecord record;
    std::vector<AovImage> layers; ///< that the scene asks for
    std::vector<std::string> warnings;
};

/// `arguments`: options of `quasilux render`, without the scene. `measuresGrids`: the scene's grids instead of its
/// sensor. Null where `watch` ended the render before its first pass. Throws InputError, DeviceError.
std::shared_ptr<const Rendered> renderScene(const LoadedScene& loaded, const std::vector<std::string>& arguments,
                                            bool measuresGrids, RenderWatch& watch);

} // namespace quasilux
