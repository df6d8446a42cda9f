// `<?quasilux quasi-specular="…"?>` in a bsdf.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

namespace quasilux {

/// Gives the lobes of a bsdf what its instructions say, where a nested bsdf said nothing. Throws InputError for keys
/// and lobes that do not exist.
void applyQuasiSpecular(const Element& bsdf, std::vector<LobeDescription>& front, std::vector<LobeDescription>& back);

} // namespace quasilux
