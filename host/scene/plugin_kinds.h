// Which plugin is of which kind, for scenes that name plugins alone.
#pragma once

#include "scene/xml/names.h"

namespace quasilux {

/// The tag of its elements, "bsdf" of "diffuse"; of plugins that only Mitsuba has, too. Empty for one that is not
/// known.
std::string_view tagOfPlugin(std::string_view plugin);

/// Of all kinds.
Names pluginNames();

} // namespace quasilux
