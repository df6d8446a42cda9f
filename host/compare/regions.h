// Regions of a picture, by a mask image: each distinct value or colour is one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace quasilux {

/// Pixels are counted row by row from the top left.
struct Region {
    std::string name;
    std::vector<size_t> pixels;
};

/// A name for one or several values of the mask; groups may overlap.
struct RegionGroup {
    std::string name;
    std::vector<std::string> values;
};

/// "NAME=VALUE,VALUE..." Throws InputError.
RegionGroup parseRegionGroup(const std::string& text);

Region wholePicture(unsigned width, unsigned height);

/// Regions of the mask in the order of their first pixel, or those of `groups` if there are any. A value is written as
/// the file holds it: "30" where all channels of all pixels are equal or there is one, "#ff8000" for colours of 8 bits,
/// else "0.5:1:0"; alpha is not looked at. Throws InputError: not readable, another size, more than 256 values, a value
/// that is not finite, a value of a group that is not in the mask.
std::vector<Region> readRegions(const std::string& path, unsigned width, unsigned height,
                                const std::vector<RegionGroup>& groups);

/// The whole picture, then regions of the mask; `mask` empty: none.
std::vector<Region> chooseRegions(const std::string& mask, const std::vector<RegionGroup>& groups, unsigned width,
                                  unsigned height);

} // namespace quasilux
