// The documents of the project, as text.
#pragma once

#include "support/read_text.h"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace quasilux::test {

inline const std::filesystem::path root = QUASILUX_SOURCE_DIR;

/// Of docs/, in the order of their names.
inline std::vector<std::filesystem::path> pages() {
    std::vector<std::filesystem::path> list;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "docs"))
        if (entry.path().extension() == ".md") list.push_back(entry.path());
    std::sort(list.begin(), list.end());
    return list;
}

} // namespace quasilux::test
