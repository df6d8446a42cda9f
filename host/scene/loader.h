// Loading of a scene that is a tree already. Of files: loadScene in scene.h.
#pragma once

#include "scene/xml/xml_document.h"

namespace quasilux {

/// `document`: checked, as readSceneDocument returns it; `path` names the scene in messages about all of it. Throws
/// InputError.
Scene loadScene(const SceneDocument& document, const std::string& path, const LoadChoice& choice);

} // namespace quasilux
