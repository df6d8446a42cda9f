// Bytes as files of a folder of their own.
#pragma once

#include "util/temporary_folder.h"

#include <fstream>
#include <string>
#include <string_view>

namespace quasilux::fuzz {

/// The folder of this process.
inline const std::filesystem::path& folder() {
    static const TemporaryFolder only;
    return only.path();
}

/// Path of the file.
inline std::string write(const std::string& name, std::string_view content) {
    const std::string path = (folder() / name).string();
    std::ofstream(path, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return path;
}

} // namespace quasilux::fuzz
