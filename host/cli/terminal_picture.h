// A picture in the terminal, for terminals that can show one.
#pragma once

#include "output/png.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

/// 8-bit sRGB, three channels side by side, row by row.
struct ShownPicture {
    unsigned width = 0, height = 0;
    std::vector<uint8_t> pixels;
};

/// By the graphics protocol of kitty: a PNG in base64, in pieces.
/// From: https://sw.kovidgoyal.net/kitty/graphics-protocol/, "Remote client".
std::string kittyText(const ShownPicture& picture);
/// By DEC's sixels, with a palette of 6 x 6 x 6 colours and ordered dithering.
/// From: DEC STD 070, "Video Systems Reference Manual", chapter 9 (sixel graphics).
std::string sixelText(const ShownPicture& picture);

/// Tone-mapped as the PNG would be, of blocks of pixels so large that neither side is longer than `longest`.
ShownPicture smallPicture(const FilmImage& image, const ExposureChoice& exposure, unsigned longest);

/// On stdout, by "kitty" or "sixel". Returns a warning where that is no terminal.
std::optional<std::string> showImage(const std::string& how, const FilmImage& image, const ExposureChoice& exposure);

} // namespace quasilux
