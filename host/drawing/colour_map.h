// Colours for values, in maps that those who do not see all colours can read, too: their lightness rises all the way.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace quasilux {

struct Colour {
    uint8_t r = 0, g = 0, b = 0;

    friend bool operator==(const Colour&, const Colour&) = default;
};

/// viridis: Smith & van der Walt 2015 (matplotlib, CC0). cividis: Nuñez, Anderton & Renslow 2018, "Optimizing colormaps
/// with consideration for color vision deficiency", PLoS ONE 13(7), made so that people with and without colour vision
/// see the same differences.
enum class ColourMap { viridis, cividis, grey };

/// For `--map`.
std::vector<std::string> colourMapNames();
/// Of one of colourMapNames().
ColourMap parseColourMap(const std::string& name);

/// Of a share from 0 to 1; what lies beyond has the colour of the end. Not of NaN.
Colour colourOf(ColourMap map, double share);

/// Of what is not finite; no map has it.
inline constexpr Colour notFinite{255, 0, 255};

} // namespace quasilux
