// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace quasilux {

/// Throws InputError unless a file `path` with this extension (".exr", any case) can be created or replaced. `option`
/// is named in the message ("--png"). Leaves nothing behind.
void checkOutputPath(const std::string& path, const std::string& option, const std::string& extension);

/// Write to temporary(), then commit(). Without a commit the temporary file is removed at the end of the scope.
class AtomicFile {
public:
    explicit AtomicFile(std::string path);
    /// `temporary`: a name that does not differ from process to process, so that those that are killed leave no more
    /// than one file. It is another's until an OutputStream has it.
    AtomicFile(std::string path, std::string temporary)
        : path_(std::move(path)), temporary_(std::move(temporary)), isOurs_(false) {}
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::string& temporary() const { return temporary_; }
    /// Renames to the final name, replacing an older file, when all of it is on the disk. Throws std::system_error.
    void commit();
    /// The same, but an older file stays, by the name `earlier`.
    void commitKeeping(const std::string& earlier);

private:
    friend class OutputStream;
    void keep(const std::string& earlier);
    void rename();

    std::string path_, temporary_;
    bool isOurs_ = true, committed_ = false;
    int lock_ = -1; ///< descriptor that holds the lock until the file has its final name
};

/// Bytes into the temporary file, which no other process writes until that is renamed or removed. Every failure throws
/// std::system_error with what the system said of it.
class OutputStream {
public:
    /// `path` is the final name, for messages.
    OutputStream(AtomicFile& file, std::string path);
    ~OutputStream();
    OutputStream(const OutputStream&) = delete;
    OutputStream& operator=(const OutputStream&) = delete;

    void write(const void* data, size_t bytes);
    /// The next write is at this place.
    void seek(int64_t offset);
    /// Some file systems say only here that the disk is full.
    void close();

private:
    std::string path_;
    int descriptor_ = -1;
};

/// Whole or not at all. Throws std::system_error.
void writeText(const std::string& path, const std::string& text);

} // namespace quasilux
