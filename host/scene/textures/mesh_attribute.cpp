// <texture type="mesh_attribute">: what a mesh file says of its vertices or faces. Each shape has its own
// (texture_use.h).
#include "scene/textures/texture_plugin.h"

#include <fmt/format.h>

namespace quasilux {

void readMeshAttribute(Properties& properties, TextureDescription& texture) {
    texture.attribute = properties.string("name", "");
    const auto begins = [&](const char* prefix) { return texture.attribute.rfind(prefix, 0) == 0; };
    if (!begins("vertex_") && !begins("face_"))
        throw InputError(properties.where("name"),
                         fmt::format("{} has the name '{}'; expected <string name=\"name\" value=\"vertex_…\"/> or "
                                     "\"face_…\", such as vertex_color.",
                                     properties.describe(), texture.attribute));
    texture.device.type = begins("face_") ? TEXTURE_FACE_ATTRIBUTE : TEXTURE_VERTEX_ATTRIBUTE;
    texture.attributeScale = static_cast<float>(properties.number("scale", 1));
    texture.device.color0 = texture.device.color1 = {1, 1, 1}; // of a value the largest that is let pass
}

} // namespace quasilux
