// What all readers of image files share, by OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace quasilux {

/// As many as an image may have: 3.2 GB of texels.
inline constexpr int64_t mostImagePixels = 1 << 28;

/// What is wrong with the size that a header states; empty: nothing.
std::string faultOfSize(const OIIO::ImageSpec& spec);

/// Gives `take` the first `channels` channels of some rows after the other, from the top, interleaved: what a header
/// promises takes no memory before the file has it. Returns what is wrong with the file; empty: nothing.
std::string readRows(OIIO::ImageInput& input, int channels,
                     const std::function<void(const float* values, size_t count)>& take);
/// All rows into `values`.
std::string readRows(OIIO::ImageInput& input, int channels, std::vector<float>& values);

} // namespace quasilux
