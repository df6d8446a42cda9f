// <texture type="checkerboard">: two colours in turn, squares of side 1/2 in texture coordinates.
#include "scene/textures/texture_plugin.h"

namespace quasilux {

void readCheckerboard(Properties& properties, TextureDescription& texture) {
    texture.device.type = TEXTURE_CHECKERBOARD;
    const TextureUse use = texture.use == TextureUse::index ? TextureUse::index : TextureUse::reflectance;
    const Reflectance first = readReflectance(properties, "color0", 0.4f, use);
    const Reflectance second = readReflectance(properties, "color1", 0.2f, use);
    // Of a texture the largest value, which its own never exceed.
    texture.device.color0 = first.largest;
    texture.device.color1 = second.largest;
    texture.device.texture0 = first.texture;
    texture.device.texture1 = second.texture;
}

} // namespace quasilux
