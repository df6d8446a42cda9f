// .vol files for tests.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace quasilux::test {

/// The content of a file of version 3: `values` with channels side by side, x fastest, z slowest.
inline std::string volFile(std::array<uint32_t, 3> size, uint32_t channels, const std::vector<float>& values,
                           const std::array<float, 6>& box = {0, 0, 0, 1, 1, 1}) {
    std::string content = "VOL\x03";
    const auto append = [&](const auto& value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        content.append(bytes, sizeof value);
    };
    append(uint32_t(1));
    for (const uint32_t n : size) append(n);
    append(channels);
    for (const float x : box) append(x);
    for (const float x : values) append(x);
    return content;
}

} // namespace quasilux::test
