// Reading of textures, and of reflectances that may be one. A new plugin is one file here and one line in the table of
// texture_table.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads a <texture>. Throws InputError for unknown plugins and parameters, and for images that cannot be read.
TextureDescription readTexture(const Element& element, LoadContext& context, TextureUse use = TextureUse::reflectance);

/// Whether the plugin is unknown, and forgiven: a grey of 0.5 then.
bool replacesTexture(const Element& element, LoadContext& context);

/// Spectra among them.
Names texturePluginNames();

void readCheckerboard(Properties& properties, TextureDescription& texture);
void readBitmap(Properties& properties, TextureDescription& texture);
void readMeshAttribute(Properties& properties, TextureDescription& texture);
void readVolumeTexture(Properties& properties, TextureDescription& texture);
/// A volume of one channel: of a grid the luminance, of a constant the mean of the channels, as in Mitsuba 3.9.
VolumeDescription numbersOf(const VolumeDescription& volume);

/// A reflectance as the scene gives it: a colour, or 1 times a texture.
struct Reflectance {
    Reflectance(Rgb color) : scale(color), largest(color) {}
    Reflectance(unsigned textureNumber, Rgb largestValue) : largest(largestValue), texture(textureNumber) {}

    Rgb scale{1, 1, 1};
    Rgb largest;          ///< of every channel, over the texture
    unsigned texture = 0; ///< as in shared::Lobe
};

/// The parameter `name`, a colour or a texture, within [0, 1] unless an index; `missing` where it is not given.
Reflectance readReflectance(Properties& properties, const std::string& name, float missing,
                            TextureUse use = TextureUse::reflectance);
/// The parameter `name`, a colour within a texture of that use.
Rgb readTextureColor(Properties& properties, const std::string& name, float missing, TextureUse use);

/// What an emitter's parameter gives: a colour, or 1 times a texture that may exceed 1.
struct EmissionColor {
    Rgb scale{1, 1, 1};
    std::optional<unsigned> texture; ///< index into Scene::textures
};

/// The parameter `name`, a colour or a texture; `missing` where it is not given; a texture that is black all over is
/// black. Of an emitter that is no shape, what is looked up by place is refused.
EmissionColor readEmission(Properties& properties, const std::string& name, Rgb missing, bool ofShape);

/// A number as the scene gives it, or a texture of numbers.
struct Scalar {
    double value = 0;                ///< of a texture its mean
    std::optional<unsigned> texture; ///< index into Scene::textures, of equal channels

    bool isZero() const { return !texture && value == 0; }
};

/// Index into Scene::textures of the colours that `element` gives; read once however often it is used.
unsigned useColorTexture(const Element& element, LoadContext& context, TextureUse use = TextureUse::reflectance);
/// And of the numbers, as readShare takes them.
unsigned useScalarTexture(const Element& element, LoadContext& context, TextureUse use = TextureUse::reflectance);

/// Mean of numbers as the lookup of a texture at random places has it; of an attribute of meshes, not known yet,
/// `missing`.
float meanOfNumbers(const TextureDescription& texture, const Scene& scene, float missing);

/// The parameter `name`, a number or a texture within [0, 1], such as a weight; `missing` where it is not given. Of the
/// colours of a texture it takes, as Mitsuba, the luminance (bitmap, gridvolume) or the mean of the channels (others); a
/// checkerboard's squares change places then, as in Mitsuba 3.9.
Scalar readShare(Properties& properties, const std::string& name, float missing);
/// The texture `name` of numbers for that use, taken likewise; of an attribute the mean is taken to be `missing`.
Scalar readNumbers(Properties& properties, const std::string& name, float missing, TextureUse use);
/// `value` of the parameter within [0, 1].
double clampedWeight(Properties& properties, const std::string& name, double value);
/// The same as readShare; a number out of range becomes the nearest with a warning, as Mitsuba clamps what it blends by.
Scalar readWeight(Properties& properties, const std::string& name, float missing);

/// Reads an image file. Files of integers are taken as sRGB encoded unless `raw`; one channel is grey, alpha is left
/// out. Reflectances above 1 become 1, negative radiance and indices of refraction 0; heights are as they are. Throws
/// InputError at `where` where the file cannot be read, or has non-finite values or negative reflectances.
Image readImage(const std::string& path, bool raw, TextureUse use, const SourceLocation& where, LoadGuard& guard);

} // namespace quasilux
