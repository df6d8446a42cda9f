// The table of texture plugins, and what is common to reading any of them.
#include "scene/plugin_lookup.h"
#include "scene/textures/constant_texture.h"
#include "scene/textures/texture_plugin.h"
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
int useTexture(const Element& element, LoadContext& context, TextureUse use = TextureUse::reflectance) {
    auto& indices = use == TextureUse::emission ? context.emissionTextureIndex : context.textureIndex;
    const auto known = indices.find(&element);
    if (known != indices.end()) return known->second;
    context.scene.textures.push_back(readTexture(element, context, use));
    const int index = static_cast<int>(context.scene.textures.size()) - 1;
    indices.emplace(&element, index);
    return index;
}

bool isGrey(Rgb color) { return color.r == color.g && color.r == color.b; }

bool isGreyBitmap(const TextureDescription& texture) {
    const auto grey = [](Rgb color) { return isGrey(color); };
    return std::all_of(texture.texels.begin(), texture.texels.end(), grey);
}

Rgb greyOf(float value) { return {value, value, value}; }
Rgb meanOf(Rgb color) { return greyOf((color.r + color.g + color.b) / 3); }
Rgb luminanceOf(Rgb color) { return greyOf(0.212671f * color.r + 0.715160f * color.g + 0.072169f * color.b); }

/// Index of the texture of numbers that the one of colours at `index` is where numbers are wanted.
unsigned scalarTexture(unsigned index, LoadContext& context) {
    std::vector<TextureDescription>& textures = context.scene.textures;
    const unsigned type = textures[index].device.type;
    if (type == TEXTURE_BITMAP && isGreyBitmap(textures[index])) return index;
    const auto known = context.scalarTextureIndex.find(static_cast<int>(index));
    if (known != context.scalarTextureIndex.end()) return known->second;
    TextureDescription grey = textures[index];
    grey.isNumber = true;
    if (type == TEXTURE_CHECKERBOARD) {
        // Mitsuba 3.9 has the squares the other way round where it asks a checkerboard for numbers.
        std::swap(grey.device.color0, grey.device.color1);
        std::swap(grey.device.texture0, grey.device.texture1);
        grey.device.color0 = meanOf(grey.device.color0);
        grey.device.color1 = meanOf(grey.device.color1);
        for (unsigned* number : {&grey.device.texture0, &grey.device.texture1})
            if (*number > 0) *number = scalarTexture(*number - 1, context) + 1;
    }
    if (grey.volume && grey.volume->device.channels != 1)
        grey.volume = std::make_shared<const VolumeDescription>(meanOfChannels(*grey.volume));
    std::vector<Rgb> luminances(grey.texels.size());
    std::transform(grey.texels.begin(), grey.texels.end(), luminances.begin(), luminanceOf);
    grey.texels = std::move(luminances);
    textures.push_back(std::move(grey));
    const auto copy = static_cast<unsigned>(textures.size() - 1);
    context.scalarTextureIndex.emplace(static_cast<int>(index), copy);
    return copy;
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

Reflectance readReflectance(Properties& properties, const std::string& name, float missing) {
    const Element* texture = properties.texture(name);
    if (!texture) return properties.reflectance(name, missing);
    if (replacesTexture(*texture, properties.context())) return Rgb{0.5f, 0.5f, 0.5f};
    const int index = useTexture(*texture, properties.context());
    const TextureDescription& read = properties.context().scene.textures[static_cast<size_t>(index)];
    return {static_cast<unsigned>(index) + 1, largestValue(read)};
}

EmissionColor readEmission(Properties& properties, const std::string& name, Rgb missing) {
    const Element* texture = properties.texture(name);
    if (!texture) return {properties.emission(name, missing), std::nullopt};
    if (replacesTexture(*texture, properties.context())) return {{0.5f, 0.5f, 0.5f}, std::nullopt};
    const int index = useTexture(*texture, properties.context(), TextureUse::emission);
    const TextureDescription& read = properties.context().scene.textures[static_cast<size_t>(index)];
    if (!read.attribute.empty() || read.volume || read.device.texture0 > 0 || read.device.texture1 > 0)
        throw InputError(texture->where,
                         fmt::format("the texture '{}' of {} gives what is emitted, so it must be a 'bitmap' or a "
                                     "'checkerboard' of two colours; bake it into an image.",
                                     name, properties.describe()));
    if (isBlack(largestValue(read)))
        throw InputError(texture->where,
                         fmt::format("the texture '{}' of {} is black, so it emits nothing; remove the emitter.", name,
                                     properties.describe()));
    return {{1, 1, 1}, static_cast<unsigned>(index)};
}

unsigned useColorTexture(const Element& element, LoadContext& context) {
    return static_cast<unsigned>(useTexture(element, context));
}

unsigned useScalarTexture(const Element& element, LoadContext& context) {
    return scalarTexture(static_cast<unsigned>(useTexture(element, context)), context);
}

unsigned squaredTexture(unsigned index, float factor, float least, LoadContext& context) {
    const auto [known, isNew] = context.squaredTextureIndex.emplace(
        std::pair(index, factor), static_cast<unsigned>(context.scene.textures.size()));
    if (!isNew) return known->second;
    TextureDescription squares = context.scene.textures[index];
    const auto squareOf = [&](const Rgb& value) {
        return greyOf(std::min(std::max(value.r * value.r * factor, least), 1.0f));
    };
    std::vector<Rgb> pixels;
    pixels.reserve(squares.texels.size());
    for (const Rgb& texel : squares.texels) pixels.push_back(squareOf(texel));
    squares.texels = std::move(pixels);
    squares.device.color0 = squareOf(squares.device.color0);
    squares.device.color1 = squareOf(squares.device.color1);
    context.scene.textures.push_back(std::move(squares));
    return known->second;
}

float meanNumber(const TextureDescription& texture, float missing, const Scene& scene) {
    if (!texture.attribute.empty()) return missing;
    if (texture.device.type == TEXTURE_CHECKERBOARD) {
        const auto ofSquares = [&](const Rgb& color, unsigned number) {
            return number > 0 ? meanNumber(scene.textures[number - 1], missing, scene) : color.r;
        };
        return 0.5f * (ofSquares(texture.device.color0, texture.device.texture0) +
                       ofSquares(texture.device.color1, texture.device.texture1));
    }
    double sum = 0;
    if (texture.volume) {
        for (const float value : texture.volume->values) sum += value;
        return static_cast<float>(sum / double(texture.volume->values.size()));
    }
    for (const Rgb& texel : texture.texels) sum += texel.r;
    return static_cast<float>(sum / double(texture.texels.size()));
}

Scalar readShare(Properties& properties, const std::string& name, float missing) {
    if (const Element* texture = properties.texture(name)) return {0, useScalarTexture(*texture, properties.context())};
    return {static_cast<float>(properties.share(name, missing)), std::nullopt};
}

} // namespace quasilux
