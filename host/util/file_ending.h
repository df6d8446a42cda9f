// Endings of file names.
#pragma once

#include <string>

namespace quasilux {

/// ".exr" of "a/b.EXR", empty where there is none.
std::string fileEnding(const std::string& path);

} // namespace quasilux
