// <texture type="bitmap">: an image; its first row, the upper one, begins at v = 0.
#include "scene/textures/texture_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

/// One that the scene holds, or of a file, read once. Warns of values that are out of range.
const Image& imageOf(const std::string& name, bool raw, TextureUse use, const SourceLocation& where,
                     LoadContext& context) {
    if (context.embedded) {
        const auto held = context.embedded->images.find(name);
        if (held != context.embedded->images.end()) return held->second;
    }
    const std::string path = context.files.resolve(name, where);
    const auto key = std::tuple(path, raw, use);
    const auto known = context.images.find(key);
    if (known != context.images.end()) return known->second;
    const Image& image =
        context.images.emplace(key, readImage(path, raw, use, where, context.files.guard())).first->second;
    const char* const what = use == TextureUse::reflectance
                                 ? "above 1 and are taken as 1: a surface cannot reflect more light than it gets"
                                 : "negative and are taken as 0";
    if (image.clamped > 0)
        context.warn(
            where, fmt::format("{} of the {} pixels of '{}' are {}.", image.clamped, image.pixels.size(), name, what));
    return image;
}

} // namespace

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

    const Image& image = imageOf(name, raw, texture.use, where, properties.context());
    texture.device.width = image.width;
    texture.device.height = image.height;
    texture.texels = image.pixels;
}

} // namespace quasilux
