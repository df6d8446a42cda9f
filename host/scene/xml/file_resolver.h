// Where files are looked for that a scene names.
#pragma once

#include "scene/load_guard.h"
#include "util/error.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

using Folders = std::vector<std::string>;

/// The folder that a file lies in.
std::string folderOf(const std::string& file);
/// The first of the files of that name in `folders` that exist.
std::optional<std::string> findIn(const Folders& folders, const std::string& name);

/// As Mitsuba's: the folders of <path>, the last one first, then that of the scene; and then that of the file that
/// mentions the name, as parts of scenes are often kept together.
class FileResolver {
public:
    /// `guard`: of a scene that is not trusted; null: it is.
    explicit FileResolver(const std::string& scene, std::shared_ptr<LoadGuard> guard = nullptr);

    /// Adds the folder that `value` names, relative to the file at `where` or to those known already, and returns it.
    /// Throws InputError if there is none.
    std::string prepend(const std::string& value, const SourceLocation& where);

    /// The file that `name` means; where none is found, the place where it should be. Throws InputError where the scene
    /// may not read it.
    std::string resolve(const std::string& name, const SourceLocation& where) const { return resolve(name, where, {}); }
    /// The same, with a look into folders `before` the others.
    std::string resolve(const std::string& name, const SourceLocation& where, const Folders& before) const;

    /// Counts what is read.
    LoadGuard& guard() const { return *guard_; }

private:
    std::string find(const std::string& name, const SourceLocation& where) const;

    Folders folders_;
    std::shared_ptr<LoadGuard> guard_;
};

} // namespace quasilux
