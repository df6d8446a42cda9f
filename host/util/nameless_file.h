// A temporary file that ends with its descriptor, whatever ends the program.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>

namespace quasilux {

/// Of a file in the folder to read and write; below 0: none can be made, and errno says why.
inline int openNamelessFile(const std::filesystem::path& folder) {
    std::string pattern = (folder / ("quasilux-" + std::string(6, 'X'))).string();
    const int file = mkstemp(pattern.data());
    if (file >= 0) unlink(pattern.c_str());
    return file;
}

} // namespace quasilux
