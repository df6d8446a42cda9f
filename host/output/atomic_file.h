// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <string>

namespace quasilux {

/// Throws InputError unless a file `path` with this extension (".exr", any case) can be created or replaced. `option`
/// is named in the message ("--png"). Leaves nothing behind.
void checkOutputPath(const std::string& path, const std::string& option, const std::string& extension);

/// Write to temporary(), then commit(). Without a commit the temporary file is removed at the end of the scope.
class AtomicFile {
public:
    explicit AtomicFile(std::string path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::string& temporary() const { return temporary_; }
    /// Renames to the final name, replacing an older file. Throws std::runtime_error.
    void commit();

private:
    std::string path_, temporary_;
    bool committed_ = false;
};

/// Whole or not at all. Throws std::runtime_error.
void writeText(const std::string& path, const std::string& text);

} // namespace quasilux
