// Bytes as files of a folder of their own, and how scenes of them are read.
#pragma once

#include "scene/scene.h"
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

/// A scene of these bytes is not trusted; what it does not know is an error or not.
inline LoadChoice choiceOf(std::string_view input) {
    LoadChoice choice;
    choice.unknown = input.size() % 2 == 0 ? Unknown::refused : Unknown::forgiven;
    choice.limits.emplace();
    choice.limits->elements = 2000;
    choice.limits->pixels = 1 << 20;
    choice.limits->seconds = 20;
    return choice;
}

} // namespace quasilux::fuzz
