// What is in a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quasilux::test {

/// Names of its files.
inline std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    return names;
}

} // namespace quasilux::test
