// `<?quasilux quasi-specular="…"?>` in a bsdf or a medium.
#pragma once

#include "scene/scene.h"
#include "scene/xml/element.h"

#include <string_view>

namespace quasilux {

/// Gives the lobes of a bsdf what its instructions say, where a nested bsdf said nothing. Throws InputError for keys
/// and lobes that do not exist.
void applyQuasiSpecular(const Element& bsdf, std::vector<LobeDescription>& front, std::vector<LobeDescription>& back);

/// What the instructions of a medium say of its phase function. Throws InputError for unknown keys and values.
QuasiSpecularChoice readMediumQuasiSpecular(const Element& medium);

/// Whether `text` begins with "level:".
bool isPhaseLevel(std::string_view text);
/// NUMBER of "level:NUMBER", sr^-1. Throws InputError where it is not positive and finite, in single precision too.
double parsePhaseLevel(std::string_view text, const SourceLocation& where);

} // namespace quasilux
