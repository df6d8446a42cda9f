// Embree, which makes the tree, is a library of the system: it may be another one than quasilux was built with.
#pragma once

#include <string>

namespace quasilux {

/// "3.13.5"; empty where Embree does not start.
std::string embreeVersion();

} // namespace quasilux
