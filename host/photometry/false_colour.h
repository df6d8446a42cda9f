// Pictures in false colours, with their scale.
#pragma once

#include "drawing/drawing.h"
#include "drawing/value_scale.h"
#include "photometry/luminance_image.h"

namespace quasilux {

struct FalseColours {
    ColourMap map = ColourMap::viridis;
    ValueScale scale;
};

/// Of a luminance, for a picture of the whole: from 0 to what 2 % of the pixels lie above, which lamps mostly are.
ValueScale scaleOfImage(const LuminanceImage& image, bool logarithmic);

/// The colours of an image: 8-bit RGB. What is not finite has the colour notFinite.
std::vector<uint8_t> falseColours(const std::vector<float>& values, const FalseColours& colours);

/// Which ends of a scale some values lie beyond.
struct Beyond {
    bool below = false, above = false;
};
template <typename Values>
Beyond beyondScale(const Values& values, const ValueScale& scale) {
    Beyond found;
    for (const auto value : values) {
        found.below |= value < scale.from;
        found.above |= value > scale.to;
    }
    return found;
}

/// The bar with its marks, `height` high, its upper left corner there; it is legendWidth wide.
inline constexpr double legendWidth = 110;
void addLegend(Drawing& drawing, Place corner, double height, const FalseColours& colours, const std::string& unit,
               const Beyond& beyond);

/// The picture, its scale on the right, and a line of figures.
Drawing falseColourDrawing(const LuminanceImage& image, const FalseColours& colours, const std::string& title);

} // namespace quasilux
