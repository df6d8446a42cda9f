// Meshes, images and IES files that a scene holds itself, where XML names files.
#pragma once

#include "scene/scene.h"

#include <map>
#include <memory>
#include <string>

namespace quasilux {

struct MeshSource;

/// An image as it is looked up: linear, row by row from the top, three channels.
struct Image {
    unsigned width = 0, height = 0;
    Texels pixels;
    unsigned clamped = 0; ///< pixels that were out of range
};

/// By the names under which elements mention them: `name` of <shape type="mesh">, `filename` of <texture
/// type="bitmap"> and <emitter type="quasilux_ies">.
struct EmbeddedParts {
    std::map<std::string, std::shared_ptr<const MeshSource>> meshes;
    std::map<std::string, Image> images;
    std::map<std::string, std::string> goniograms; ///< contents of IES files
};

} // namespace quasilux
