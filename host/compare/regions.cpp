// Values of a mask as text, and the pixels that have them.
#include "compare/regions.h"

#include "images/image_rows.h"
#include "util/error.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <numeric>

namespace quasilux {

namespace {

constexpr size_t maximumRegions = 256; // more are no mask, but a photograph or one with smoothed edges

/// Pixels of one or three channels in the numbers of the file.
struct Mask {
    size_t channels = 1;
    bool bytes = false; ///< 8 bits to a channel
    std::vector<float> values;
};

/// OpenImageIO spreads whole numbers over 0 .. 1 when it makes floats of them.
double fullScale(const OIIO::TypeDesc& format) {
    if (format.is_floating_point()) return 1;
    return format.basetype == OIIO::TypeDesc::UINT8 ? 255 : format.basetype == OIIO::TypeDesc::UINT16 ? 65535 : 0;
}

Mask readMask(const std::string& path, unsigned width, unsigned height) {
    // Alpha must not change the colours below it.
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &wish);
    if (!input) throw InputError(fmt::format("--mask {}: cannot read the image: {}", path, OIIO::geterror()));
    const OIIO::ImageSpec spec = input->spec();
    if (spec.width != static_cast<int>(width) || spec.height != static_cast<int>(height))
        throw InputError(fmt::format("--mask {}: has {} x {} pixels, expected {} x {} as the images", path, spec.width,
                                     spec.height, width, height));
    const double scale = fullScale(spec.format);
    if (scale == 0 || spec.deep)
        throw InputError(fmt::format("--mask {}: pixels are {}, expected 8 or 16 bits or floating point", path,
                                     spec.format.c_str()));
    Mask mask{spec.nchannels >= 3 ? size_t{3} : size_t{1}, spec.format.basetype == OIIO::TypeDesc::UINT8, {}};
    if (const auto fault = readRows(*input, static_cast<int>(mask.channels), mask.values); !fault.empty())
        throw InputError(fmt::format("--mask {}: cannot read the pixels: {}", path, fault));
    for (float& value : mask.values) {
        if (!std::isfinite(value)) throw InputError(fmt::format("--mask {}: holds a value that is not finite", path));
        if (scale != 1) value = static_cast<float>(std::lround(value * scale));
    }
    return mask;
}

bool isGrey(const Mask& mask) {
    for (size_t i = 0; i + 2 < mask.values.size(); i += 3)
        if (mask.values[i] != mask.values[i + 1] || mask.values[i] != mask.values[i + 2]) return false;
    return true;
}

std::string valueText(const float* value, bool grey, bool bytes) {
    if (grey) return fmt::format("{}", value[0]);
    if (!bytes) return fmt::format("{}:{}:{}", value[0], value[1], value[2]);
    return fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(value[0]), static_cast<int>(value[1]),
                       static_cast<int>(value[2]));
}

std::vector<Region> regionsByValue(const std::string& path, const Mask& mask) {
    const bool grey = mask.channels == 1 || isGrey(mask);
    std::vector<Region> regions;
    std::map<std::vector<float>, size_t> index;
    for (size_t pixel = 0; pixel < mask.values.size() / mask.channels; ++pixel) {
        const float* value = &mask.values[pixel * mask.channels];
        const auto [found, added] = index.try_emplace({value, value + mask.channels}, regions.size());
        if (added) regions.push_back({valueText(value, grey, mask.bytes), {}});
        if (regions.size() > maximumRegions)
            throw InputError(fmt::format("--mask {}: has more than {} distinct values, expected one for each region; "
                                         "save it without smoothed edges and without lossy compression",
                                         path, maximumRegions));
        regions[found->second].pixels.push_back(pixel);
    }
    return regions;
}

/// Pixels of all values of the group, in order.
Region grouped(const std::string& path, const std::vector<Region>& regions, const RegionGroup& group) {
    Region result{group.name, {}};
    for (const auto& value : group.values) {
        const auto found =
            std::find_if(regions.begin(), regions.end(), [&](const Region& r) { return r.name == value; });
        if (found == regions.end()) {
            std::vector<std::string> names;
            names.reserve(regions.size());
            for (const auto& region : regions) names.push_back(region.name);
            throw InputError(fmt::format("--region {}: no pixel of {} has the value {}, expected some of {}",
                                         group.name, path, value, fmt::join(names, ", ")));
        }
        result.pixels.insert(result.pixels.end(), found->pixels.begin(), found->pixels.end());
    }
    std::sort(result.pixels.begin(), result.pixels.end());
    result.pixels.erase(std::unique(result.pixels.begin(), result.pixels.end()), result.pixels.end());
    return result;
}

} // namespace

RegionGroup parseRegionGroup(const std::string& text) {
    const auto fail = [&] {
        return InputError(fmt::format("--region '{}': expected NAME=VALUE or NAME=VALUE,VALUE...", text));
    };
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) throw fail();
    RegionGroup group{text.substr(0, equals), {}};
    if (group.name == "all") throw InputError("--region all: that name means the whole picture, expected another");
    for (size_t first = equals + 1; first <= text.size();) {
        const size_t end = std::min(text.find(',', first), text.size());
        if (end == first) throw fail();
        group.values.push_back(text.substr(first, end - first));
        first = end + 1;
    }
    if (group.values.empty()) throw fail();
    return group;
}

Region wholePicture(unsigned width, unsigned height) {
    Region region{"all", std::vector<size_t>(size_t{width} * height)};
    std::iota(region.pixels.begin(), region.pixels.end(), size_t{0});
    return region;
}

std::vector<Region> readRegions(const std::string& path, unsigned width, unsigned height,
                                const std::vector<RegionGroup>& groups) {
    std::vector<Region> regions = regionsByValue(path, readMask(path, width, height));
    if (groups.empty()) return regions;
    std::vector<Region> result;
    result.reserve(groups.size());
    for (const auto& group : groups) result.push_back(grouped(path, regions, group));
    return result;
}

std::vector<Region> chooseRegions(const std::string& mask, const std::vector<RegionGroup>& groups, unsigned width,
                                  unsigned height) {
    std::vector<Region> regions{wholePicture(width, height)};
    if (mask.empty()) return regions;
    for (auto& region : readRegions(mask, width, height, groups)) regions.push_back(std::move(region));
    return regions;
}

} // namespace quasilux
