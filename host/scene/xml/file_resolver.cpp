#include "scene/xml/file_resolver.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

bool isThere(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

} // namespace

std::string folderOf(const std::string& file) { return fs::path(file).parent_path().string(); }

std::optional<std::string> findIn(const Folders& folders, const std::string& name) {
    for (const std::string& folder : folders)
        if (const fs::path found = fs::path(folder) / name; isThere(found)) return found.string();
    return std::nullopt;
}

FileResolver::FileResolver(const std::string& scene, std::shared_ptr<LoadGuard> guard)
    : folders_{folderOf(scene)}, guard_(guard ? std::move(guard) : std::make_shared<LoadGuard>(scene)) {}

std::string FileResolver::prepend(const std::string& value, const SourceLocation& where) {
    std::string folder = (fs::path(folderOf(where.file)) / value).string();
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) folder = find(value, where);
    guard_->admitFolder(folder, where);
    if (!fs::is_directory(folder, ignored))
        throw InputError(
            where, fmt::format("the folder '{}' does not exist; write it relative to this file, or remove the <path>.",
                               value));
    if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end())
        folders_.insert(folders_.begin(), folder);
    return folder;
}

std::string FileResolver::resolve(const std::string& name, const SourceLocation& where, const Folders& before) const {
    const auto found = findIn(before, name);
    std::string path = found ? *found : find(name, where);
    guard_->admit(path, where);
    return path;
}

std::string FileResolver::find(const std::string& name, const SourceLocation& where) const {
    if (const auto found = findIn(folders_, name)) return *found;
    return (fs::path(folderOf(where.file)) / name).string();
}

} // namespace quasilux
