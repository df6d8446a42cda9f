// Published colours at every eighth of 256 places, linear between: within 6 of 255 of the published ones in any
// channel.
#include "drawing/colour_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

using Places = std::array<uint32_t, 33>;

constexpr Places viridis{0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086, 0x3e4989, 0x3b528b,
                         0x375b8d, 0x33638d, 0x2f6b8e, 0x2c728e, 0x297a8e, 0x26828e, 0x23898e, 0x21918c, 0x1f978b,
                         0x1f9f88, 0x21a685, 0x27ad81, 0x31b57b, 0x3dbc74, 0x4cc26c, 0x5cc863, 0x6ece58, 0x81d34d,
                         0x95d840, 0xaadc32, 0xc0df25, 0xd5e21a, 0xeae51a, 0xfde725};
constexpr Places cividis{0x00224e, 0x00285b, 0x002e6a, 0x053371, 0x1a386f, 0x273e6e, 0x32436d, 0x3b496c, 0x434e6c,
                         0x4b546c, 0x535a6d, 0x5a5f6e, 0x61656f, 0x686a71, 0x6f7073, 0x767676, 0x7d7c78, 0x838179,
                         0x8b8778, 0x928d78, 0x9a9376, 0xa29975, 0xaaa073, 0xb3a670, 0xbbad6d, 0xc3b369, 0xccba64,
                         0xd4c15f, 0xddc858, 0xe6d051, 0xefd748, 0xf8df3c, 0xfee838};

Colour between(const Places& places, double share) {
    const double at = share * (places.size() - 1);
    const auto first = std::min(static_cast<size_t>(at), places.size() - 2);
    const double t = at - static_cast<double>(first);
    const auto channel = [&](unsigned shift) {
        const double from = places[first] >> shift & 255u, to = places[first + 1] >> shift & 255u;
        return static_cast<uint8_t>(std::lround(from + t * (to - from)));
    };
    return {channel(16), channel(8), channel(0)};
}

} // namespace

std::vector<std::string> colourMapNames() { return {"viridis", "cividis", "grey"}; }

ColourMap parseColourMap(const std::string& name) {
    if (name == "viridis") return ColourMap::viridis;
    if (name == "cividis") return ColourMap::cividis;
    if (name == "grey") return ColourMap::grey;
    throw std::logic_error("no colour map " + name);
}

Colour colourOf(ColourMap map, double share) {
    const double inside = std::clamp(share, 0.0, 1.0);
    if (map == ColourMap::viridis) return between(viridis, inside);
    if (map == ColourMap::cividis) return between(cividis, inside);
    const auto grey = static_cast<uint8_t>(std::lround(255 * inside));
    return {grey, grey, grey};
}

} // namespace quasilux
