// <bsdf type="normalmap"> and <bsdf type="bumpmap">: a nested bsdf about shading normals that a texture bends.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

unsigned readFlags(Properties& properties) {
    const bool flips = properties.boolean("flip_invalid_normals", true);
    const bool shadows = properties.boolean("use_shadowing_function", true);
    return (flips ? RELIEF_FLIPS : 0u) | (shadows ? RELIEF_SHADOWS : 0u);
}

BsdfLobes bend(Properties& properties, shared::Relief relief) {
    relief.flags = readFlags(properties);
    const std::vector<const Element*> nested = properties.objects("bsdf");
    if (nested.size() != 1)
        throw InputError(properties.element().where,
                         fmt::format("{} has {} nested bsdfs; it needs one.", properties.plugin(), nested.size()));
    BsdfLobes lobes = readBsdfLobes(*nested[0], properties.context());
    if (lobes.frontRelief || lobes.backRelief)
        throw InputError(nested[0]->where,
                         fmt::format("{}: the nested bsdf '{}' bends normals already; keep one normal or bump map.",
                                     properties.plugin(), nested[0]->get("type")));
    if (lobes.isNull) return lobes;
    lobes.frontRelief = lobes.backRelief = relief;
    return lobes;
}

/// Index of a texture that is one colour everywhere, since normals are looked up in one.
unsigned addUniformTexture(Rgb color, Properties& properties) {
    TextureDescription texture;
    texture.where = properties.where("normalmap");
    texture.device.type = TEXTURE_CHECKERBOARD;
    texture.device.color0 = texture.device.color1 = color;
    texture.device.toU[0] = texture.device.toV[1] = 1;
    std::vector<TextureDescription>& textures = properties.context().scene.textures;
    textures.push_back(std::move(texture));
    return static_cast<unsigned>(textures.size() - 1);
}

} // namespace

BsdfLobes readNormalMap(Properties& properties) {
    shared::Relief relief{};
    relief.type = RELIEF_NORMALS;
    if (const Element* texture = properties.texture("normalmap"))
        relief.texture = useColorTexture(*texture, properties.context());
    else if (properties.has("normalmap"))
        relief.texture = addUniformTexture(properties.reflectance("normalmap", 0), properties);
    else
        throw InputError(properties.element().where, "normalmap needs a <texture name=\"normalmap\"> of normals.");
    return bend(properties, relief);
}

BsdfLobes readBumpMap(Properties& properties) {
    const Element* texture = properties.object("texture");
    if (!texture) throw InputError(properties.element().where, "bumpmap needs a <texture> of heights.");
    shared::Relief relief{};
    relief.type = RELIEF_HEIGHTS;
    relief.scale = static_cast<float>(properties.number("scale", 1));
    relief.texture = useScalarTexture(*texture, properties.context(), TextureUse::height);
    if (properties.context().scene.textures[relief.texture].device.type != TEXTURE_BITMAP)
        throw InputError(texture->where,
                         fmt::format("bumpmap: a texture '{}' has no slope; use a bitmap.", texture->get("type")));
    return bend(properties, relief);
}

} // namespace quasilux
