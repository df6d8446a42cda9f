// Reads scene files: XML with positions, `<include>`, `<default>` and `$parameters` (docs/reference/scene-language.md,
// "Document").
#pragma once

#include "scene/embedded_parts.h"
#include "scene/scene.h"
#include "scene/xml/element.h"
#include "scene/xml/file_resolver.h"

#include <utility>

namespace quasilux {

using SceneParameters = std::vector<std::pair<std::string, std::string>>;

/// The `<scene>` element with included files spliced in, `$name` replaced, and every tag and attribute known.
struct SceneDocument {
    Element root;
    FileResolver files;
    std::vector<std::string> forgiven = {}; ///< unknown elements, which are left out: "file:line:column: …"
    std::vector<std::string> warnings = {};
    std::shared_ptr<const EmbeddedParts> embedded = {}; ///< null: the scene holds none
};

/// Throws InputError for a missing file, malformed XML, include loops, unknown names unless they are forgiven, and
/// unused `parameters`.
SceneDocument readSceneDocument(const std::string& path, const SceneParameters& parameters,
                                Unknown unknown = Unknown::refused, std::shared_ptr<LoadGuard> guard = nullptr);

/// Entries of `<?quasilux …?>`. Throws InputError at `where` if they are not a list of key="value".
Instruction parseInstruction(std::string_view text, const SourceLocation& where);

/// The whole of a file. Throws InputError at `where` if it cannot be read; `what` names it ("mesh", "scene").
std::string readFile(const std::string& path, const SourceLocation& where, std::string_view what);

/// The same, without the byte order mark by which editors begin UTF-8.
std::string readTextFile(const std::string& path, const SourceLocation& where, std::string_view what);

} // namespace quasilux
