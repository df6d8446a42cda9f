#include "scene/xml/read_files.h"

#include <algorithm>
#include <sys/stat.h>

namespace quasilux {

namespace {

// Of the thread that loads: readers of meshes, textures and spectra need not hand it down.
thread_local ReadFiles* noting = nullptr;

constexpr std::chrono::milliseconds betweenLooks{100};

} // namespace

ReadFiles::State ReadFiles::stateOf(const std::string& path) {
    struct stat file {};
    if (stat(path.c_str(), &file) != 0) return {};
    return {file.st_mtim.tv_sec, file.st_mtim.tv_nsec, file.st_size, file.st_ino};
}

void ReadFiles::note(const std::string& path) { states_.emplace(path, stateOf(path)); }

bool ReadFiles::haveChanged() {
    const auto now = Clock::now();
    if (now - last_ < betweenLooks) return false;
    last_ = now;
    return std::any_of(states_.begin(), states_.end(), [](const auto& file) {
        const State state = stateOf(file.first);
        return state.number != 0 && state != file.second;
    });
}

ReadFilesNoted::ReadFilesNoted(ReadFiles& files) : before_(noting) { noting = &files; }

ReadFilesNoted::~ReadFilesNoted() { noting = before_; }

void noteReadFile(const std::string& path) {
    if (noting) noting->note(path);
}

} // namespace quasilux
