// The list form of the quasi-specular setting: ids with commas between.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace quasilux {

/// The ids of `setting`; empty for auto, none, all and level:NUMBER. Throws InputError for an id that names no bsdf,
/// lobe (ID.LOBE) or medium of the scene.
std::vector<std::string> listedIds(const Scene& scene, const std::string& setting);

} // namespace quasilux
