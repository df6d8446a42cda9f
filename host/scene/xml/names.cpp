// Lists of known names for error messages.
#include "scene/xml/names.h"

#include "util/nearest.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace quasilux {

std::string lowerCase(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

std::string joinNames(const Names& names) { return fmt::format("{}", fmt::join(names, ", ")); }

std::string knownNames(std::string_view name, const Names& known) {
    constexpr size_t longest = 64; // no known name is longer, and the distance is quadratic
    if (known.empty()) return " None is known here.";
    const std::vector<std::string> words(known.begin(), known.end());
    const std::string nearest = name.size() > longest ? "" : nearestName(std::string(name), words);
    const std::string question = nearest.empty() ? "" : fmt::format(" Did you mean '{}'?", nearest);
    return fmt::format("{} Known: {}.", question, joinNames(known));
}

} // namespace quasilux
