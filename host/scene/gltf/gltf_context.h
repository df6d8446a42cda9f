// What the translators of a glTF file share: its model, where its files are, what becomes of it.
#pragma once

#include "scene/embedded_parts.h"
#include "scene/xml/file_resolver.h"

#include <fmt/format.h>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <tiny_gltf.h>
#include <vector>

namespace quasilux {

/// Of a radian.
inline constexpr double gltfDegrees = 180 / std::numbers::pi;

struct GltfContext {
    const tinygltf::Model& model;
    const std::string& path;
    const FileResolver& files;
    EmbeddedParts& parts;
    std::set<std::string> withoutEffect = {}; ///< what of the file is left out, each once
    std::set<std::string> ids = {};           ///< in use

    /// In messages "file: nodes[3]". Of indices alone, as names may hold anything.
    SourceLocation at(std::string_view element) const { return {fmt::format("{}: {}", path, element)}; }
    SourceLocation at(std::string_view list, size_t index) const {
        return {fmt::format("{}: {}[{}]", path, list, index)};
    }

    /// `name`, or with a number where that is taken; `otherwise` where it is empty.
    std::string newId(const std::string& name, const std::string& otherwise) {
        const std::string wanted = name.empty() ? otherwise : name;
        std::string id = wanted;
        for (unsigned k = 2; !ids.insert(id).second; ++k) id = fmt::format("{} #{}", wanted, k);
        return id;
    }
};

/// The entry of a list of the file. Throws InputError at `where`, which mentions it.
template <typename Entry>
const Entry& gltfEntry(const std::vector<Entry>& list, std::string_view name, int64_t index,
                       const SourceLocation& where) {
    if (index < 0 || index >= static_cast<int64_t>(list.size()))
        throw InputError(where,
                         fmt::format("{}[{}] does not exist; the file has {} of them.", name, index, list.size()));
    return list[static_cast<size_t>(index)];
}

} // namespace quasilux
