// The text of every file below kernels/, by relative name ("bsdf/phong.clh"). Made at build time.
#pragma once

#include <map>
#include <string>

namespace quasilux {

const std::map<std::string, std::string>& kernelSources();

} // namespace quasilux
