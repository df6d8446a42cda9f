#include "scene/xml/file_resolver.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

fs::path folderOf(const std::string& file) { return fs::path(file).parent_path(); }

} // namespace

FileResolver::FileResolver(const std::string& scene) : folders_{folderOf(scene).string()} {}

void FileResolver::prepend(const std::string& value, const SourceLocation& where) {
    std::string folder = (folderOf(where.file) / value).string();
    if (!fs::is_directory(folder)) folder = resolve(value, where);
    if (!fs::is_directory(folder))
        throw InputError(
            where, fmt::format("the folder '{}' does not exist; write it relative to this file, or remove the <path>.",
                               value));
    if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end())
        folders_.insert(folders_.begin(), folder);
}

std::string FileResolver::resolve(const std::string& name, const SourceLocation& where) const {
    for (const auto& folder : folders_)
        if (const fs::path found = fs::path(folder) / name; isThere(found)) return found.string();
    return (folderOf(where.file) / name).string();
}

} // namespace quasilux
