// Scenes of Mitsuba 0.x are read as Mitsuba 3 reads them: names of that time become those of today.
#pragma once

#include "scene/xml/element.h"

namespace quasilux {

/// The first number of a version such as "0.6.0", or -1.
int majorVersion(const std::string& version);

/// Tag and parameter name of an element of version 0 or 1: `lookAt` and `toWorld` become `lookat` and `to_world`.
void upgradeNames(Element& element);

/// Texture parameters of that time become a `to_uv`: uoffset, voffset, uscale, vscale. To be called with the children
/// in place.
void upgradeTextureCoordinates(Element& element);

} // namespace quasilux
