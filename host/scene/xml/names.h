// Lists of known names for error messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quasilux {

using Names = std::vector<std::string_view>;

/// " Did you mean 'x'? Known: x, y, z." with the first part left out where nothing is near.
std::string knownNames(std::string_view name, const Names& known);

/// With small letters.
std::string lowerCase(std::string text);

/// "x, y, z"
std::string joinNames(const Names& names);

} // namespace quasilux
