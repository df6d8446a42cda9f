// Colours of image files whose primaries are not those of sRGB.
#pragma once

#include <OpenImageIO/imageio.h>
#include <glm/glm.hpp>
#include <optional>

namespace quasilux {

/// What takes the first three channels of the file to linear sRGB: by the chromaticities in the header of an OpenEXR
/// file, or from CIE X, Y, Z where the channels are called so. Nothing where they are linear sRGB, as those of other
/// files are taken to be. White is not adapted, as in Mitsuba.
std::optional<glm::dmat3> toLinearSrgb(const OIIO::ImageSpec& spec);

} // namespace quasilux
