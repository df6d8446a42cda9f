#include "images/image_rows.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace quasilux {

std::string faultOfSize(const OIIO::ImageSpec& spec) {
    const bool isFlat = spec.width > 0 && spec.height > 0 && spec.depth <= 1 && spec.nchannels > 0;
    if (isFlat && int64_t(spec.width) * spec.height <= mostImagePixels) return {};
    return fmt::format("it has {} x {} x {} pixels of {} channels; expected a flat picture of at most {} pixels.",
                       spec.width, spec.height, spec.depth, spec.nchannels, mostImagePixels);
}

std::string readRows(OIIO::ImageInput& input, int channels,
                     const std::function<void(const float* values, size_t count)>& take) {
    constexpr int64_t valuesAtOnce = 1 << 22;
    const OIIO::ImageSpec& spec = input.spec();
    const bool isTiled = spec.tile_width > 0;
    const int64_t perRow = int64_t(spec.width) * channels;
    const int64_t packed = isTiled ? spec.tile_height : 64; // rows that files pack together, or whole numbers of them
    const auto atOnce = static_cast<int>(
        std::min<int64_t>(spec.height, packed * std::max<int64_t>(1, valuesAtOnce / (perRow * packed))));
    const auto values = std::make_unique_for_overwrite<float[]>(static_cast<size_t>(perRow * atOnce));
    const int end = spec.y + spec.height;
    for (int y = spec.y; y < end; y += atOnce) {
        const int next = std::min(y + atOnce, end);
        const bool isRead =
            isTiled ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, y, next, spec.z, spec.z + 1, 0, channels,
                                       OIIO::TypeDesc::FLOAT, values.get())
                    : input.read_scanlines(0, 0, y, next, spec.z, 0, channels, OIIO::TypeDesc::FLOAT, values.get());
        if (!isRead) {
            const std::string reason = input.geterror();
            return reason.empty() ? "it ends before its last row, or is damaged." : reason;
        }
        take(values.get(), static_cast<size_t>(perRow * (next - y)));
    }
    return {};
}

std::string readRows(OIIO::ImageInput& input, int channels, std::vector<float>& values) {
    const OIIO::ImageSpec& spec = input.spec();
    return readRows(input, channels, [&](const float* rows, size_t count) {
        if (values.empty()) values.reserve(spec.image_pixels() * static_cast<size_t>(channels));
        values.insert(values.end(), rows, rows + count);
    });
}

} // namespace quasilux
