// Scenes of Mitsuba 0.x are read as Mitsuba 3 reads them: names of that time become those of today.
#pragma once

#include "scene/xml/element.h"

#include <string_view>

namespace quasilux {

/// The first number of a version such as "0.6.0", or -1.
int majorVersion(const std::string& version);

/// Tag and parameter name of an element of version 0 or 1: `lookAt` and `toWorld` become `lookat` and `to_world`, and
/// `srgb` becomes an `rgb` of linear numbers.
void upgradeNames(Element& element);

/// Parameters of that time: of textures uoffset, voffset, uscale and vscale become a `to_uv`, filters and gamma what is
/// like them; the index outside of metals goes where it says nothing; `diffuse` has one name for its reflectance, and a cloud for its extinction coefficient. To be called with the children in place.
void upgradeParameters(Element& element);

/// Whether upgradeNames knows the tag, though Mitsuba 3 does not.
bool isFormerTag(std::string_view name);

} // namespace quasilux
