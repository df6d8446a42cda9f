// Textures where numbers are wanted.
#include "scene/color.h"
#include "scene/textures/texture_plugin.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

bool isGrey(Rgb color) { return color.r == color.g && color.r == color.b; }

bool isGreyBitmap(const TextureDescription& texture) {
    const auto grey = [](Rgb color) { return isGrey(color); };
    return std::all_of(texture.texels.begin(), texture.texels.end(), grey);
}

Rgb greyOf(float value) { return {value, value, value}; }
Rgb meanOf(Rgb color) { return greyOf((color.r + color.g + color.b) / 3); }
Rgb luminanceOf(Rgb color) { return greyOf(static_cast<float>(luminance(color))); }

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
        grey.volume = std::make_shared<const VolumeDescription>(numbersOf(*grey.volume));
    std::vector<Rgb> luminances(grey.texels.size());
    std::transform(grey.texels.begin(), grey.texels.end(), luminances.begin(), luminanceOf);
    grey.texels = std::move(luminances);
    textures.push_back(std::move(grey));
    const auto copy = static_cast<unsigned>(textures.size() - 1);
    context.scalarTextureIndex.emplace(static_cast<int>(index), copy);
    return copy;
}

} // namespace

float meanOfNumbers(const TextureDescription& texture, const Scene& scene, float missing) {
    if (!texture.attribute.empty()) return missing;
    if (texture.device.type == TEXTURE_CHECKERBOARD) {
        const auto ofSquares = [&](const Rgb& color, unsigned number) {
            return number > 0 ? meanOfNumbers(scene.textures[number - 1], scene, missing) : color.r;
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

unsigned useScalarTexture(const Element& element, LoadContext& context, TextureUse use) {
    return scalarTexture(useColorTexture(element, context, use), context);
}

Scalar readWeight(Properties& properties, const std::string& name, float missing) {
    if (properties.texture(name)) return readShare(properties, name, missing);
    return {clampedWeight(properties, name, properties.textureNumber(name, missing)), std::nullopt};
}

double clampedWeight(Properties& properties, const std::string& name, double value) {
    const double taken = std::clamp(value, 0.0, 1.0);
    if (taken != value)
        properties.context().warn(properties.where(name),
                                  fmt::format("parameter '{}' of {} is {}; it is taken as {}, as by Mitsuba.", name,
                                              properties.describe(), value, taken));
    return taken;
}

Scalar readShare(Properties& properties, const std::string& name, float missing) {
    if (!properties.texture(name)) return {properties.share(name, missing), std::nullopt};
    return readNumbers(properties, name, missing, TextureUse::reflectance);
}

Scalar readNumbers(Properties& properties, const std::string& name, float missing, TextureUse use) {
    const Element& texture = *properties.texture(name);
    if (replacesTexture(texture, properties.context())) return {0.5, std::nullopt};
    const unsigned index = useScalarTexture(texture, properties.context(), use);
    const Scene& scene = properties.context().scene;
    return {meanOfNumbers(scene.textures[index], scene, missing), index};
}

} // namespace quasilux
