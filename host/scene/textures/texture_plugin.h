// Reading of textures, and of reflectances that may be one. A new plugin is one file here and one line in the table of
// texture_table.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads a <texture>. Throws InputError for unknown plugins and parameters, and for images that cannot be read.
TextureDescription readTexture(const Element& element, LoadContext& context);

/// Whether the plugin is unknown, and forgiven: a grey of 0.5 then.
bool replacesTexture(const Element& element, LoadContext& context);

void readCheckerboard(Properties& properties, TextureDescription& texture);
void readBitmap(Properties& properties, TextureDescription& texture);

/// A reflectance as the scene gives it: a colour, or 1 times a texture.
struct Reflectance {
    Reflectance(Rgb color) : scale(color), largest(color) {}
    Reflectance(unsigned textureNumber, Rgb largestValue) : largest(largestValue), texture(textureNumber) {}

    Rgb scale{1, 1, 1};
    Rgb largest;          ///< of every channel, over the texture
    unsigned texture = 0; ///< as in shared::Lobe
};

/// The parameter `name`, a colour or a texture within [0, 1]; `missing` where it is not given.
Reflectance readReflectance(Properties& properties, const std::string& name, float missing);

/// Reads an image file. Files of integers are taken as sRGB encoded unless `raw`; one channel is grey, alpha is left
/// out. Throws InputError at `where` where the file cannot be read, or has negative or non-finite values.
Image readImage(const std::string& path, bool raw, const SourceLocation& where);
/// An image of radiance: as readImage, but values may be above 1, and negative ones become 0.
Image readRadianceImage(const std::string& path, const SourceLocation& where);

} // namespace quasilux
