// <texture type="volume">: a volume at the places of the surface, whatever its texture coordinates.
#include "scene/color.h"
#include "scene/textures/texture_plugin.h"
#include "scene/volumes/volume_plugin.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr float defaultValue = 0.75f;

/// The volume that is given, a colour, or the default.
VolumeDescription readShownVolume(Properties& properties, TextureUse use) {
    LoadContext& context = properties.context();
    if (const Element* element = properties.volume("volume")) {
        context.shownVolumes.insert(element);
        return readVolume(*element, context);
    }
    VolumeDescription volume;
    setConstant(volume, readTextureColor(properties, "volume", defaultValue, use), glm::dmat4(1));
    return volume;
}

} // namespace

void readVolumeTexture(Properties& properties, TextureDescription& texture) {
    VolumeDescription volume = readShownVolume(properties, texture.use);
    size_t above = 0;
    float largest = 0;
    for (float& value : volume.values) {
        if (texture.use == TextureUse::reflectance) {
            above += value > 1;
            value = std::min(value, 1.0f);
        }
        largest = std::max(largest, value);
    }
    if (above > 0)
        properties.context().warn(
            properties.element().where,
            fmt::format(
                "{} of the {} values of the volume are above 1 and are taken as 1: a surface cannot reflect more "
                "light than it gets.",
                above, volume.values.size()));
    texture.device.type = TEXTURE_VOLUME;
    texture.device.color0 = texture.device.color1 = {largest, largest, largest};
    texture.volume = std::make_shared<const VolumeDescription>(std::move(volume));
}

VolumeDescription numbersOf(const VolumeDescription& volume) {
    if (volume.device.channels == 1) return volume;
    VolumeDescription grey = volume;
    grey.device.channels = 1;
    grey.values.clear();
    const bool isConstant = volume.values.size() == 3;
    for (size_t k = 0; k < volume.values.size(); k += 3) {
        const Rgb color{volume.values[k], volume.values[k + 1], volume.values[k + 2]};
        grey.values.push_back(static_cast<float>(isConstant ? (color.r + color.g + color.b) / 3 : luminance(color)));
    }
    return grey;
}

} // namespace quasilux
