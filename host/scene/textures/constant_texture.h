// <texture type="…"> or <spectrum type="…"> that is the same colour everywhere: a spectrum.
#pragma once

#include "scene/color.h"
#include "scene/load_context.h"
#include "scene/xml/names.h"

namespace quasilux {

/// Whether the plugin of this <texture> is a spectrum.
bool isConstantTexture(const Element& element);
/// Names of all those plugins.
const Names& constantTextureNames();

/// Its colour. Throws InputError for bad parameters.
Rgb readConstantTexture(const Element& element, ColorUse use, LoadContext& context);

} // namespace quasilux
