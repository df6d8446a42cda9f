#include "util/file_ending.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace quasilux {

std::string fileEnding(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending;
}

} // namespace quasilux
