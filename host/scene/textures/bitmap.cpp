// <texture type="bitmap">: an image; its first row, the upper one, begins at v = 0.
#include "scene/textures/texture_plugin.h"

#include <fmt/format.h>

namespace quasilux {

void readBitmap(Properties& properties, TextureDescription& texture) {
    const std::string name = properties.string("filename", "");
    const SourceLocation where = properties.where("filename");
    if (name.empty())
        throw InputError(where,
                         fmt::format("{} needs <string name=\"filename\" value=\"…\"/>.", properties.describe()));
    const Names filters = {"nearest", "bilinear"}, wraps = {"repeat", "mirror", "clamp"};
    const auto indexOf = [](const Names& names, const std::string& value) {
        return static_cast<unsigned>(std::find(names.begin(), names.end(), value) - names.begin());
    };
    texture.device.type = TEXTURE_BITMAP;
    // In the order of TEXTURE_NEAREST, … and WRAP_REPEAT, ….
    texture.device.filter = indexOf(filters, properties.choice("filter_type", "bilinear", filters));
    texture.device.wrap = indexOf(wraps, properties.choice("wrap_mode", "repeat", wraps));
    const bool raw = properties.boolean("raw", false);
    properties.accept({"format", "accel"});

    const std::string path = properties.context().files.resolve(name, where);
    auto known = properties.context().images.find({path, raw});
    const bool isNew = known == properties.context().images.end();
    if (isNew) known = properties.context().images.emplace(std::pair(path, raw), readImage(path, raw, where)).first;
    const Image& image = known->second;
    if (isNew && image.clamped > 0)
        properties.context().warn(where, fmt::format("{} of the {} pixels of '{}' are above 1 and are taken as 1: a "
                                                     "surface cannot reflect more light than it gets.",
                                                     image.clamped, image.pixels.size(), name));
    texture.device.width = image.width;
    texture.device.height = image.height;
    texture.texels = image.pixels;
}

} // namespace quasilux
