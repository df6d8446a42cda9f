// Images into files that appear whole or not at all.
#pragma once

#include <OpenImageIO/imageio.h>
#include <functional>
#include <string>

namespace quasilux {

/// `format`: as OpenImageIO names it. `write` gives the pixels, and returns whether all went well. Throws
/// std::runtime_error.
void writeImage(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec,
                const std::function<bool(OIIO::ImageOutput&)>& write);

} // namespace quasilux
