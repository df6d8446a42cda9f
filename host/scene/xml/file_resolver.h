// Where files are looked for that a scene names.
#pragma once

#include "util/error.h"

#include <string>
#include <vector>

namespace quasilux {

/// As Mitsuba's: the folders of <path>, the last one first, then that of the scene; and then that of the file that mentions the name, as
/// parts of scenes are often kept together.
class FileResolver {
public:
    explicit FileResolver(const std::string& scene);

    /// A folder that `value` names, relative to the file at `where` or to those known already. Throws InputError if there is none.
    void prepend(const std::string& value, const SourceLocation& where);

    /// The file that `name` means; where none is found, the place where it should be.
    std::string resolve(const std::string& name, const SourceLocation& where) const;

private:
    std::vector<std::string> folders_;
};

} // namespace quasilux
