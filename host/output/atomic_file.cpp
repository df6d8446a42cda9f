// Temporary files in the folder of their final name.
#include "output/atomic_file.h"

#include "util/error.h"
#include "util/file_ending.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

/// In the same folder, since a rename is atomic only within one file system.
std::string temporaryName(const std::string& path) { return fmt::format("{}.{}.tmp", path, getpid()); }

/// What the system said of the last call; to be asked before any other.
[[noreturn]] void fail(const std::string& path) {
    const int why = errno;
    throw std::system_error(why, std::generic_category(), "cannot write " + path);
}

/// Until this is done a crash of the machine may lose it.
void sync(const std::string& name, int flags, const std::string& path) {
    const int descriptor = open(name.c_str(), flags | O_CLOEXEC);
    if (descriptor < 0 && (flags & O_DIRECTORY) != 0) return; // a folder that one may write to, but not read
    if (descriptor < 0) fail(path);
    // Some file systems cannot: then there is nothing to be done.
    const bool failed = fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS;
    const int why = errno;
    close(descriptor);
    errno = why;
    if (failed) fail(path);
}

/// Whether the name is still that of the open file: another process may have renamed it before its lock was free.
bool hasName(int descriptor, const std::string& name) {
    struct stat open {
    }, named{};
    return fstat(descriptor, &open) == 0 && stat(name.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
           open.st_ino == named.st_ino;
}

/// Opens and locks `name`; EWOULDBLOCK: another process has it. Below 0: errno says why.
int openLocked(const std::string& name) {
    for (unsigned tries = 0; tries < 100; ++tries) { // as often as another may be faster
        const int descriptor = open(name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
        if (descriptor < 0) return descriptor;
        const bool isOthers = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (!isOthers && hasName(descriptor, name)) return descriptor;
        close(descriptor);
        if (isOthers) break;
    }
    errno = EWOULDBLOCK;
    return -1;
}

/// Asks the file system itself: permission bits say nothing of read-only mounts, quotas or the superuser.
/// There may be one already, of a killed program that had the same PID, as all in containers have.
void probeFolder(const std::string& path, const std::string& option) {
    const std::string probe = temporaryName(path);
    const int descriptor = openLocked(probe);
    if (descriptor < 0 && errno == EWOULDBLOCK) return; // another of this PID, in its container, writes it just now
    if (descriptor < 0)
        throw InputError(fmt::format("{} {}: cannot write there ({}), choose another folder or change its permissions",
                                     option, path, std::strerror(errno)));
    unlink(probe.c_str()); // while it is locked
    close(descriptor);
}

} // namespace

void checkOutputPath(const std::string& path, const std::string& option, const std::string& extension) {
    const fs::path file(path);
    const std::string found = fileEnding(path);
    if (found != extension)
        throw InputError(fmt::format("{} {}: {}, expected a name that ends in {}{}", option, path,
                                     found.empty() ? "no extension" : "unknown extension '" + found + "'", extension,
                                     extension == ".exr" ? "; --png FILE writes a picture for the screen" : ""));
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
    if (!committed_ && isOurs_) unlink(temporary_.c_str());
    if (lock_ >= 0) close(lock_);
}

void AtomicFile::commit() {
    sync(temporary_, O_WRONLY, path_);
    rename();
}

void AtomicFile::commitKeeping(const std::string& earlier) {
    sync(temporary_, O_WRONLY, path_); // before the older file loses its name, if it must
    keep(earlier);
    rename();
}

void AtomicFile::rename() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_);
    committed_ = true;
    const fs::path folder = fs::path(path_).parent_path();
    sync(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY, path_);
}

void AtomicFile::keep(const std::string& earlier) {
    const std::string beside = earlier + ".tmp";
    unlink(beside.c_str());
    // By a second name of the file, so that `path` is there at every moment; some file systems know no second names.
    if (link(path_.c_str(), beside.c_str()) == 0) {
        const bool failed = std::rename(beside.c_str(), earlier.c_str()) != 0;
        const int why = errno;
        unlink(beside.c_str()); // it is there after a failure, and where both names were of one file
        errno = why;
        if (failed) fail(earlier);
    } else if (errno != ENOENT && std::rename(path_.c_str(), earlier.c_str()) != 0 && errno != ENOENT) {
        fail(earlier);
    }
}

OutputStream::OutputStream(AtomicFile& file, std::string path) : path_(std::move(path)) {
    descriptor_ = openLocked(file.temporary());
    if (descriptor_ < 0 && errno == EWOULDBLOCK)
        throw std::system_error(EWOULDBLOCK, std::generic_category(),
                                "cannot write " + path_ + ", which another process writes just now");
    if (descriptor_ < 0) fail(path_);
    file.isOurs_ = true;
    file.lock_ = fcntl(descriptor_, F_DUPFD_CLOEXEC, 0); // one lock, which ends with the last of both
    if (file.lock_ < 0 || ftruncate(descriptor_, 0) != 0) {
        const int why = errno;
        ::close(std::exchange(descriptor_, -1));
        errno = why;
        fail(path_);
    }
}

OutputStream::~OutputStream() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputStream::write(const void* data, size_t bytes) {
    const char* next = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t written = ::write(descriptor_, next, bytes);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path_);
        next += written;
        bytes -= static_cast<size_t>(written);
    }
}

void OutputStream::seek(int64_t offset) {
    if (lseek(descriptor_, offset, SEEK_SET) < 0) fail(path_);
}

void OutputStream::close() {
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_);
}

void writeText(const std::string& path, const std::string& text) {
    AtomicFile file(path);
    OutputStream stream(file, path);
    stream.write(text.data(), text.size());
    stream.close();
    file.commit();
}

} // namespace quasilux
