// <texture type="checkerboard">: two colours in turn, squares of side 1/2 in texture coordinates.
#include "scene/textures/texture_plugin.h"

namespace quasilux {

void readCheckerboard(Properties& properties, TextureDescription& texture) {
    texture.device.type = TEXTURE_CHECKERBOARD;
    texture.device.color0 = properties.reflectance("color0", 0.4f);
    texture.device.color1 = properties.reflectance("color1", 0.2f);
}

} // namespace quasilux
