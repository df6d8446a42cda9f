// The table of texture plugins, and what is common to reading any of them.
#include "scene/plugin_lookup.h"
#include "scene/textures/constant_texture.h"
#include "scene/textures/texture_plugin.h"
#include "scene/textures/texture_use.h"
#include "scene/transform.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

struct TexturePlugin {
    std::string_view name;
    void (*read)(Properties&, TextureDescription&);
    bool hasCoordinates = true; ///< that to_uv transforms
};

constexpr TexturePlugin texturePlugins[] = {{"checkerboard", readCheckerboard},
                                            {"bitmap", readBitmap},
                                            {"mesh_attribute", readMeshAttribute, false},
                                            {"volume", readVolumeTexture, false}};

/// As in Mitsuba, what the transform does within the plane of x and y.
void readToUv(Properties& properties, shared::Texture& texture) {
    const glm::dmat4 toUv = properties.transform("to_uv");
    const int columns[3] = {0, 1, 3};
    for (int i = 0; i < 3; ++i) {
        texture.toU[i] = static_cast<float>(toUv[columns[i]][0]);
        texture.toV[i] = static_cast<float>(toUv[columns[i]][1]);
    }
}

Rgb larger(Rgb a, Rgb b) { return {std::max(a.r, b.r), std::max(a.g, b.g), std::max(a.b, b.b)}; }

Rgb largestValue(const TextureDescription& texture) {
    Rgb value = larger(texture.device.color0, texture.device.color1);
    for (const Rgb& texel : texture.texels) value = larger(value, texel);
    return value;
}

/// Index into Scene::textures; read once however often it is used.
int useTexture(const Element& element, LoadContext& context, TextureUse use) {
    const auto known = context.textureIndex.find(&element);
    if (known != context.textureIndex.end() && known->second.count(use) > 0) return known->second.at(use);
    context.scene.textures.push_back(readTexture(element, context, use));
    const int index = static_cast<int>(context.scene.textures.size()) - 1;
    context.textureIndex[&element].emplace(use, index);
    return index;
}

} // namespace

Names texturePluginNames() { return namesOf(texturePlugins, constantTextureNames()); }

bool replacesTexture(const Element& element, LoadContext& context) {
    return !findPlugin(texturePlugins, element, context, "0.5 everywhere", constantTextureNames());
}

TextureDescription readTexture(const Element& element, LoadContext& context, TextureUse use) {
    const TexturePlugin& plugin = findPlugin(texturePlugins, element, constantTextureNames());
    std::vector<const Element*>& open = context.openTextures;
    context.enter(element, open);
    Properties properties(element, context);
    TextureDescription texture;
    texture.where = element.where;
    texture.use = use;
    if (plugin.hasCoordinates) readToUv(properties, texture.device);
    plugin.read(properties, texture);
    properties.finish();
    open.pop_back();
    return texture;
}

Rgb readTextureColor(Properties& properties, const std::string& name, float missing, TextureUse use) {
    if (use == TextureUse::index) return properties.positiveColor(name, {missing, missing, missing});
    return properties.reflectance(name, missing);
}

Reflectance readReflectance(Properties& properties, const std::string& name, float missing, TextureUse use) {
    const Element* texture = properties.texture(name);
    if (!texture) return readTextureColor(properties, name, missing, use);
    if (replacesTexture(*texture, properties.context())) return Rgb{0.5f, 0.5f, 0.5f};
    const int index = useTexture(*texture, properties.context(), use);
    const TextureDescription& read = properties.context().scene.textures[static_cast<size_t>(index)];
    return {static_cast<unsigned>(index) + 1, largestValue(read)};
}

EmissionColor readEmission(Properties& properties, const std::string& name, Rgb missing, bool ofShape) {
    const Element* texture = properties.texture(name);
    if (!texture) return {properties.emission(name, missing), std::nullopt};
    if (replacesTexture(*texture, properties.context())) return {{0.5f, 0.5f, 0.5f}, std::nullopt};
    const int index = useTexture(*texture, properties.context(), TextureUse::emission);
    const TextureDescription& read = properties.context().scene.textures[static_cast<size_t>(index)];
    const Scene& scene = properties.context().scene;
    for (const unsigned shown : withNested(scene, {static_cast<unsigned>(index)}))
        if (!ofShape && (!scene.textures[shown].attribute.empty() || scene.textures[shown].volume))
            throw InputError(texture->where,
                             fmt::format("the texture '{}' of {} gives what is emitted from one point, which has no "
                                         "attributes and no place in a volume; use a 'bitmap' or a 'checkerboard'.",
                                         name, properties.describe()));
    if (isBlack(largestValue(read))) return {{0, 0, 0}, std::nullopt};
    return {{1, 1, 1}, static_cast<unsigned>(index)};
}

unsigned useColorTexture(const Element& element, LoadContext& context, TextureUse use) {
    return static_cast<unsigned>(useTexture(element, context, use));
}

} // namespace quasilux
