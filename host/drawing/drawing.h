// A drawing of lines, texts and pictures, made once and written as SVG or as a picture of pixels
// (docs/reference/command-line.md#false-colours).
#pragma once

#include "drawing/colour_map.h"

#include <string>
#include <variant>
#include <vector>

namespace quasilux {

struct Place {
    double x = 0, y = 0; ///< pixels from the top left
};

inline constexpr Colour black{0x22, 0x22, 0x22}, midGrey{0x66, 0x66, 0x66}, paleGrey{0xcc, 0xcc, 0xcc},
    white{0xff, 0xff, 0xff};

/// Through all its places.
struct DrawnLine {
    std::vector<Place> places;
    Colour colour = black;
    double width = 1;
    bool dashed = false;
};

struct DrawnCircle {
    Place centre;
    double radius = 0;
    Colour colour = black;
    double width = 1;
};

/// Filled.
struct DrawnBox {
    Place corner;
    double width = 0, height = 0;
    Colour colour = white;
};

enum class TextAnchor { start, middle, end };
struct DrawnText {
    Place place; ///< on the base line
    std::string text;
    TextAnchor anchor = TextAnchor::start;
    Colour colour = black;
    double size = 12;
    bool bold = false;
    bool haloed = false; ///< a white rim, over lines and colours
};

/// Pixels spread over a box, none smoothed.
struct DrawnPicture {
    Place corner;
    double width = 0, height = 0;
    unsigned columns = 0, rows = 0;
    std::vector<uint8_t> pixels; ///< 8-bit RGB, row by row from the top
};

using DrawnThing = std::variant<DrawnLine, DrawnCircle, DrawnBox, DrawnText, DrawnPicture>;

struct Drawing {
    double width = 0, height = 0;
    std::string title;              ///< for those who do not see it
    std::vector<DrawnThing> things; ///< later ones over earlier ones

    template <typename Thing>
    void add(Thing thing) {
        things.emplace_back(std::move(thing));
    }
};

/// Text that needs nothing besides itself.
std::string svgOf(const Drawing& drawing);

/// 8-bit RGB on white, ceil(width) x ceil(height). Throws std::runtime_error where the computer has no font.
std::vector<uint8_t> pixelsOf(const Drawing& drawing);

} // namespace quasilux
