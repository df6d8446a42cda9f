// What a scene that somebody else has made may take while it is loaded (docs/reference/reliability.md, "Scenes of
// others").
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace quasilux {

struct LoadLimits {
    bool staysInside = true; ///< all files lie in the folder of the scene, symbolic links resolved
    uint64_t memory = 4096;  ///< MiB beyond what the program has before
    uint64_t files = 1000;
    uint64_t mebibytes = 1024; ///< in all files
    uint64_t pixels = 1 << 26; ///< in all images
    uint64_t elements = 1000000;
    uint64_t nesting = 8; ///< files that include each other
    uint64_t seconds = 60;
};

/// A limit by the name that users know it by.
struct NamedLimit {
    std::string_view name, of; ///< "files", "files"; "memory", "MiB of memory"
    uint64_t LoadLimits::*value;
};
inline constexpr std::array<NamedLimit, 7> namedLimits{
    {{"memory", "MiB of memory", &LoadLimits::memory},
     {"files", "files", &LoadLimits::files},
     {"mebibytes", "MiB in files", &LoadLimits::mebibytes},
     {"pixels", "pixels in images", &LoadLimits::pixels},
     {"elements", "elements", &LoadLimits::elements},
     {"nesting", "files that include each other", &LoadLimits::nesting},
     {"seconds", "seconds to load", &LoadLimits::seconds}}};

} // namespace quasilux
