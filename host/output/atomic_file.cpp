// Temporary files in the folder of their final name.
#include "output/atomic_file.h"

#include "util/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

/// In the same folder, since a rename is atomic only within one file system.
std::string temporaryName(const std::string& path) { return fmt::format("{}.{}.tmp", path, getpid()); }

/// Asks the file system itself: permission bits say nothing of read-only mounts, quotas or the superuser.
void probeFolder(const std::string& path, const std::string& option) {
    const std::string probe = temporaryName(path);
    const int descriptor = open(probe.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0)
        throw InputError(fmt::format("{} {}: cannot write there ({}), choose another folder or change its permissions",
                                     option, path, std::strerror(errno)));
    close(descriptor);
    unlink(probe.c_str());
}

} // namespace

void checkOutputPath(const std::string& path, const std::string& option, const std::string& extension) {
    const fs::path file(path);
    std::string found = file.extension().string();
    std::transform(found.begin(), found.end(), found.begin(), [](unsigned char c) { return std::tolower(c); });
    if (found != extension)
        throw InputError(fmt::format("{} {}: {}, expected a name that ends in {}", option, path,
                                     found.empty() ? "no extension" : "unknown extension '" + found + "'", extension));
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code status;
    if (!fs::is_directory(folder, status))
        throw InputError(
            fmt::format("{} {}: folder {} does not exist, create it first", option, path, folder.string()));
    if (fs::is_directory(file, status))
        throw InputError(fmt::format("{} {}: is a folder, expected the name of a file", option, path));
    if (fs::exists(file, status) && access(path.c_str(), W_OK) != 0)
        throw InputError(fmt::format("{} {}: the file exists and is write-protected", option, path));
    probeFolder(path, option);
}

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), temporary_(temporaryName(path_)) {}

AtomicFile::~AtomicFile() {
    if (!committed_) unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot write " + path_);
    committed_ = true;
}

void writeText(const std::string& path, const std::string& text) {
    AtomicFile file(path);
    std::ofstream stream(file.temporary(), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) throw std::system_error(errno, std::generic_category(), "cannot write " + path);
    file.commit();
}

} // namespace quasilux
