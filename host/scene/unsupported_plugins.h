// Plugins of Mitsuba that quasilux does not have, and what to do instead.
#pragma once

#include <string_view>

namespace quasilux {

/// Of a plugin of <`tag`>; empty for one that Mitsuba has not either.
std::string_view insteadOfUnsupported(std::string_view tag, std::string_view plugin);

/// The tag of such a plugin; empty for others.
std::string_view tagOfUnsupported(std::string_view plugin);

} // namespace quasilux
