// Where files are looked for that a scene names.
#pragma once

#include "scene/load_guard.h"
#include "util/error.h"

#include <memory>
#include <string>
#include <vector>

namespace quasilux {

/// As Mitsuba's: the folders of <path>, the last one first, then that of the scene; and then that of the file that
/// mentions the name, as parts of scenes are often kept together.
class FileResolver {
public:
    /// `guard`: of a scene that is not trusted; null: it is.
    explicit FileResolver(const std::string& scene, std::shared_ptr<LoadGuard> guard = nullptr);

    /// A folder that `value` names, relative to the file at `where` or to those known already. Throws InputError if
    /// there is none.
    void prepend(const std::string& value, const SourceLocation& where);

    /// The file that `name` means; where none is found, the place where it should be. Throws InputError where the scene
    /// may not read it.
    std::string resolve(const std::string& name, const SourceLocation& where) const;

    /// Counts what is read.
    LoadGuard& guard() const { return *guard_; }

private:
    std::string find(const std::string& name, const SourceLocation& where) const;

    std::vector<std::string> folders_;
    std::shared_ptr<LoadGuard> guard_;
};

} // namespace quasilux
